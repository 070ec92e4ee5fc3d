#pragma once
// One function a command: adds it to the parser and says what to run once the whole line is understood.
#include <CLI/CLI.hpp>
#include <functional>
#include <memory>

#include "welkin/app/cli.h"
#include "welkin/app/options.h"

namespace welkin::app {

void addRender(CLI::App& app, Action& action);
void addFly(CLI::App& app, Action& action, const std::string& commandLine);
void addPlan(CLI::App& app, Action& action);
void addBench(CLI::App& app, Action& action);
void addConverge(CLI::App& app, Action& action, const std::string& commandLine);
void addInfo(CLI::App& app, Action& action);
void addCompare(CLI::App& app, Action& action);
void addProbe(CLI::App& app, Action& action);
void addStress(CLI::App& app, Action& action);

// --size --budget --depth --step --detail --seed --gpu, then --quiet --json.
void addQualityOptions(CLI::App& command, CommonOptions& options);
void addTimeOption(CLI::App& command, CommonOptions& options);
void addToleranceOption(CLI::App& command, CommonOptions& options);  // render, fly
void addOutputOptions(CLI::App& command, CommonOptions& options, const char* jsonText);
void addGpuOption(CLI::App& command, CommonOptions& options);

// Sets the log up, once the options are known.
void beginCommand(const CommonOptions& options);

// An option whose text a function reads; its error becomes wrong usage.
template <class T, class Parse, class Set>
CLI::Option* addParsed(CLI::App& command, const std::string& name, const std::string& help, Parse parse, Set set) {
  return command.add_option_function<std::string>(
      name,
      [name, parse, set](const std::string& text) {
        Result<T> value = parse(text);
        if (!value) throw CLI::ValidationError(name, value.error().message);
        set(*value);
      },
      help);
}

}  // namespace welkin::app
