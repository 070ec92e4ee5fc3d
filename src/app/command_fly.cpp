#include "welkin/app/commands.h"
#include "welkin/app/flight.h"

namespace welkin::app {

void addFly(CLI::App& app, Action& action, const std::string& commandLine) {
  auto o = std::make_shared<FlightOptions>();
  o->command = commandLine;
  auto* command = app.add_subcommand("fly", "replay a recorded path: timings, pictures, a contact sheet, a video");
  command->footer("Example:\n  welkin fly benchmarks/orbit-to-ground.json --out out/orbit-to-ground --video out/flight.mp4");
  command->add_option("PATH", o->path, "the recorded path (JSON)")->required();
  addParsed<FrameRange>(*command, "--frames", "frames FIRST:END, END not included", parseRange, [o](FrameRange v) { o->range = v; });
  command->add_option("--out", o->out, "folder for what is written (default: out/NAME of the path)");
  command->add_option("--video", o->video, "also write this video (needs ffmpeg)");
  command->add_option("--every", o->every, "a picture every N frames, 0 for none (default: about a dozen)")->check(CLI::Range(0, 1000000));
  addParsed<std::vector<int>>(*command, "--quality-frames",
                              "compare these frames, such as 0,100,200, with the converged picture of their pose", parseFrameList,
                              [o](std::vector<int> v) { o->qualityFrames = std::move(v); });
  addParsed<FrameRange>(*command, "--pop",
                        "frames FIRST:END to measure popping at: their pose fully marched with the tree before and after; \":\" for all",
                        parseRange, [o](FrameRange v) { o->pop = v; });
  command->add_option("--bricks-per-frame", o->bricksPerFrame, "bricks generated at most in one frame")->check(CLI::Range(1, 1000000));
  command->add_option("--worker-jitter", o->workerJitter,
                      "seed of random delays in the worker thread, to test that pictures do not depend on them");
  command
      ->add_option_function<std::string>(
          "--pace", [o](const std::string& pace) { o->waitForEdits = pace == "fixed"; },
          "fixed: the same pictures on every run; wall: never wait for the worker")
      ->check(CLI::IsMember({"fixed", "wall"}));
  addParsed<DebugView>(*command, "--debug", "pictures in false colours: " + namesText(kDebugViewNames),
                       parseName<DebugView>(kDebugViewNames), [o](DebugView v) { o->debug = v; })
      ->excludes("--quality-frames")
      ->excludes("--pop");
  addQualityOptions(*command, o->common);
  addToleranceOption(*command, o->common);
  addOutputOptions(*command, o->common, "where the timings go (default: timings.json in the folder)");
  command->callback([o, &action] {
    action = [o] {
      beginCommand(o->common);
      return fly(*o);
    };
  });
}

}  // namespace welkin::app
