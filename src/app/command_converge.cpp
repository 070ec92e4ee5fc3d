#include "welkin/app/commands.h"
#include "welkin/app/converge.h"
#include "welkin/app/tolerance_sweep.h"

namespace welkin::app {

void addConverge(CLI::App& app, Action& action, const std::string& commandLine) {
  auto o = std::make_shared<ConvergeOptions>();
  o->common.size = Size{320, 180};
  o->command = commandLine;
  auto* command = app.add_subcommand("converge", "error against run time over a sweep of settings");
  command->footer(
      "Examples:\n  welkin converge benchmarks/poses/near.json --json near.json --html near.html\n"
      "  welkin converge benchmarks/poses/near.json --preset thesis --html thesis.html\n"
      "  welkin converge screenshots/layers.png --sweep integrator=rectangle,exponential-linear --sweep step=0.64,0.32,0.16");
  command->add_option("SCENE", o->input, "a scene (JSON), a picture (PNG, EXR) of this program, or a path (JSON)")->required();
  command->add_option("--view", o->view, "which view of the scene");
  command->add_option("--html", o->html, "write plots, pictures and the table to this file");
  addParsed<std::size_t>(
      *command, "--preset", "which sweep: " + namesText(kPresetNames) + " (default: default)",
      [](const std::string& text) { return findName(kPresetNames, text); }, [o](std::size_t i) { o->preset = kPresetNames[i]; });
  command
      ->add_option_function<std::vector<std::string>>(
          "--sweep",
          [o](const std::vector<std::string>& texts) {
            for (const auto& text : texts) {
              auto axis = parseSweep(text);
              if (!axis) throw CLI::ValidationError("--sweep", axis.error().message);
              o->sweep.push_back(std::move(*axis));
            }
          },
          "AXIS=A,B,C in place of a preset; several: all combinations. Axes: " + namesText(kSweepAxes))
      ->expected(1)
      ->take_all();
  addParsed<TruthKind>(*command, "--truth", "what errors are from: " + namesText(kTruthNames), parseName<TruthKind>(kTruthNames),
                       [o](TruthKind kind) { o->truth = kind; });
  command->add_option("--truth-every", o->truthEvery, "tree, source: of N x N pixels one (default: 1; source: 8)")
      ->check(CLI::Range(1, 1000));
  command->add_option("--repeat", o->repetitions, "timed frames of each setting (default: 7)")->check(CLI::Range(1, 1000));
  command->add_option("--poses", o->poses, "poses of a path, evenly along it (default: 5)")->check(CLI::Range(1, 1000));
  auto tolerances = std::make_shared<std::vector<double>>();
  addParsed<std::vector<double>>(*command, "--tolerance",
                                 "E,F,...: instead of a sweep, what --tolerance picks in every view, against all that it could have picked", parseTolerances,
                                 [tolerances](std::vector<double> v) { *tolerances = std::move(v); });
  addQualityOptions(*command, o->common);
  addTimeOption(*command, o->common);
  addOutputOptions(*command, o->common, "write the report to this file");
  command->callback([o, tolerances, &action] {
    action = [o, tolerances] {
      beginCommand(o->common);
      if (!tolerances->empty()) return toleranceSweep({o->common, o->input, o->view, *tolerances});
      return converge(*o);
    };
  });
}

}  // namespace welkin::app
