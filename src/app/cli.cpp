#include "welkin/app/cli.h"

#include <exception>

#include "welkin/app/commands.h"
#include "welkin/app/build_info.h"
#include "welkin/core/files.h"
#include "welkin/core/log.h"
#include "welkin/core/units.h"
#include "welkin/physics/scene_io.h"
#include "welkin/physics/scene_time.h"

namespace welkin::app {
namespace {

constexpr int kFailed = 1, kWrongUsage = 2;

// "12 34" of a number option must not pass, nor NaN.
Result<double> parseNumber(const std::string& text, double low, double high) {
  char* end = nullptr;
  const double v = std::strtod(text.c_str(), &end);
  if (!text.empty() && *end == '\0' && v >= low && v <= high) return v;
  return Error{fmt::format("expected a number from {} to {}, got {}", low, high, oneLine(text, 60))};
}

Result<std::int64_t> parseWhole(const std::string& text, std::int64_t low, std::int64_t high) {
  char* end = nullptr;
  errno = 0;
  const long long v = std::strtoll(text.c_str(), &end, 10);
  if (!text.empty() && *end == '\0' && errno == 0 && v >= low && v <= high) return std::int64_t(v);
  return Error{fmt::format("expected a whole number from {} to {}, got {}", low, high, oneLine(text, 60))};
}

}  // namespace

void beginCommand(const CommonOptions& options) { initLog(options.quiet); }

void addGpuOption(CLI::App& command, CommonOptions& options) {
  command.add_option("--gpu", options.gpu, "auto, software, or the index of a device")->check([](const std::string& text) {
    if (text == "auto" || text == "software" ||
        (!text.empty() && text.size() < 4 && text.find_first_not_of("0123456789") == std::string::npos))
      return "";
    return "expected auto, software, or the index of a device";
  });
}

void addQualityOptions(CLI::App& command, CommonOptions& o) {
  addParsed<Size>(command, "--size", "picture size, WIDTHxHEIGHT", parseSize, [&o](Size v) { o.size = v; });
  const auto budget = [](const std::string& text) -> Result<std::uint64_t> {
    auto bytes = parseBytes(text);
    if (bytes && (*bytes < kMinBudget_bytes || *bytes > kMaxBudget_bytes)) return Error{"expected 1MiB to 1024GiB"};
    return bytes;
  };
  addParsed<std::uint64_t>(command, "--budget", "memory of the GL that may be used, such as 512MiB", budget,
                           [&o](std::uint64_t v) { o.budget_bytes = v; });
  addParsed<std::int64_t>(
      command, "--depth", "deepest level of the octree, 1 to 24", [](const std::string& t) { return parseWhole(t, 1, 24); },
      [&o](std::int64_t v) { o.depth = int(v); });
  addParsed<double>(
      command, "--step", "length of a march step; smaller is finer and slower",
      [](const std::string& t) { return parseNumber(t, 1e-6, 1000); }, [&o](double v) { o.step = v; });
  addParsed<Integrator>(command, "--integrator", "how a march segment adds up: " + namesText(kIntegratorNames), parseName<Integrator>(kIntegratorNames),
                        [&o](Integrator v) { o.integrator = v; });
  addParsed<StepRule>(command, "--step-rule", "what a march step is measured in: " + namesText(kStepRuleNames), parseName<StepRule>(kStepRuleNames),
                      [&o](StepRule v) { o.stepRule = v; });
  command.add_flag("--march-empty", o.marchEmpty, "march empty nodes like others, for comparisons");
  addParsed<double>(
      command, "--spread", "how unlike marched pixels may look, 0-255, for those between them to be interpolated; 0: all are marched",
      [](const std::string& t) { return parseNumber(t, 0, 255); }, [&o](double v) { o.spread = v; });
  addParsed<double>(
      command, "--detail", "nodes a radian wanted; 0: as fine as the budget allows",
      [](const std::string& t) { return parseNumber(t, 0, 1e6); }, [&o](double v) { o.detail = v; });
  addParsed<std::int64_t>(
      command, "--seed", "seed of the procedural weather", [](const std::string& t) { return parseWhole(t, 0, 4294967295); },
      [&o](std::int64_t v) { o.seed = std::uint32_t(v); });
  addParsed<Exposure>(command, "--exposure", "stops over the base exposure, or auto: metered", parseExposure,
                      [&o](Exposure v) { o.exposure = v; });
  addParsed<ToneCurve>(command, "--tone-curve", namesText(kToneCurveNames), parseName<ToneCurve>(kToneCurveNames),
                       [&o](ToneCurve v) { o.toneCurve = v; });
  addGpuOption(command, o);
}

void addTimeOption(CLI::App& command, CommonOptions& o) {
  addParsed<double>(
      command, "--time", "seconds of the scene's time: where its day has brought the sun, and the wind the clouds",
      [](const std::string& t) { return parseNumber(t, -kGreatestTime_s, kGreatestTime_s); }, [&o](double v) { o.time_s = v; });
}

void addToleranceOption(CLI::App& command, CommonOptions& o) {
  addParsed<double>(
      command, "--tolerance", "error that the picture may have, RMSE on 0-255: step and detail are picked to keep it as cheaply as they can",
      [](const std::string& t) { return parseNumber(t, 0.01, 255); }, [&o](double v) { o.tolerance_255 = v; });
}

void addOutputOptions(CLI::App& command, CommonOptions& options, const char* jsonText) {
  command.add_option("--json", options.json, jsonText);
  command.add_flag("--quiet,-q", options.quiet, "no log lines and no progress bar, only warnings and errors");
}

int runProgram(int argc, const char* const* argv, const AddCommand& more) {
  std::string commandLine = "welkin";
  for (int i = 1; i < argc; ++i) commandLine += std::string(" ") + argv[i];
  CLI::App app("Welkin draws a whole planet's air and clouds, from orbit down to the inside of a cloud.", "welkin");
  app.footer(
      "Example:\n  welkin render scenes/earth.json --view orbit -o orbit.png\n\n`welkin COMMAND --help` says more, with an example.");
  app.set_version_flag("--version", buildText());
  app.require_subcommand(1);
  Action action;
  if (more) more(app, action);
  addRender(app, action);
  addFly(app, action, commandLine);
  addPlan(app, action);
  addBench(app, action);
  addConverge(app, action, commandLine);
  addInfo(app, action);
  addCompare(app, action);
  addProbe(app, action);
  addStress(app, action);
  initLog(false);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    fmt::print(stderr, "welkin: {} (welkin --help says more)\n", oneLine(error.what(), 300));
    return kWrongUsage;
  }
  try {
    const Result<void> done = action();
    if (done) return 0;
    fmt::print(stderr, "welkin: {}\n", done.error().message);
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "welkin: not enough memory\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "welkin: {}\n", oneLine(error.what(), 300));
  }
  return kFailed;
}

}  // namespace welkin::app
