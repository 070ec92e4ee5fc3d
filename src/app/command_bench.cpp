#include "welkin/app/commands.h"
#include "welkin/app/bench.h"

namespace welkin::app {

void addBench(CLI::App& app, Action& action) {
  auto o = std::make_shared<BenchOptions>();
  o->common.size = Size{320, 180};
  auto* command = app.add_subcommand("bench", "measure one pose: cost of a frame by pass, error of the step, cold start");
  command->footer("Example:\n  welkin bench benchmarks/poses/near.json --json near.json");
  command->add_option("SCENE", o->scene, "a scene (JSON), or a picture (PNG, EXR) of this program")->required();
  command->add_option("--view", o->view, "which view of the scene");
  command->add_option("--frames", o->frames, "frames of each kind that the medians are over (default: 30)")->check(CLI::Range(1, 100000));
  command->add_flag("!--no-cold-start", o->coldStart, "do not measure how long a start from an empty tree takes");
  addQualityOptions(*command, o->common);
  addTimeOption(*command, o->common);
  addOutputOptions(*command, o->common, "write the same and more to this file");
  command->callback([o, &action] {
    action = [o] {
      beginCommand(o->common);
      return bench(*o);
    };
  });
}

}  // namespace welkin::app
