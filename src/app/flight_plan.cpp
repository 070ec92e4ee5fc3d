#include "welkin/app/flight.h"
#include "welkin/app/video.h"
#include "welkin/core/files.h"
#include "welkin/physics/scene_io.h"

namespace welkin::app {
namespace {
constexpr int kPictures = 12;  // along the way, if not said otherwise: three rows of a contact sheet
}

double altitude_m(const View& view, const Planet& planet) { return glm::length(view.position_m) - planet.radius_m; }

std::string pictureName(int frame) { return fmt::format("frame-{:05}.png", frame); }

bool pictureWanted(const FlightPlan& plan, int frame) {
  return plan.every > 0 && ((frame - plan.first) % plan.every == 0 || frame + 1 == plan.end);
}

Result<FlightPlan> planFlight(const FlightOptions& options) {
  FlightPlan plan;
  auto path = loadPath(options.path);
  if (!path) return path.error();
  plan.path = std::move(*path);
  auto scene = loadScene(plan.path.scene);
  if (!scene) return Error{fmt::format("{}: /scene: {}", options.path.string(), scene.error().message)};
  plan.scene = std::move(*scene);
  if (auto above = checkPath(plan.path, plan.scene.planet); !above) return above.error();
  apply(options.common, plan.scene);
  for (PathFrame& frame : plan.path.frames) apply(options.common, frame.view);
  plan.size = options.common.size.value_or(Size{plan.path.width, plan.path.height});

  const int frames = int(plan.path.frames.size());
  plan.first = options.range.first;
  plan.end = options.range.end.value_or(frames);
  if (plan.first >= frames || plan.end > frames) {
    return Error{fmt::format("{}: /frames: expected --frames inside 0:{}, got {}:{}", options.path.string(), frames, plan.first, plan.end)};
  }
  for (const int frame : options.qualityFrames) {
    if (frame >= plan.first && frame < plan.end) continue;
    return Error{
        fmt::format("{}: /frames: expected --quality-frames inside {}:{}, got {}", options.path.string(), plan.first, plan.end, frame)};
  }
  plan.every = options.every.value_or(std::max(1, (plan.end - plan.first + kPictures - 2) / (kPictures - 1)));
  plan.framesPerSecond = plan.path.timeStep_s > 0 ? std::clamp(1 / plan.path.timeStep_s, 1.0, 240.0) : 30;

  plan.out = options.out.empty() ? std::filesystem::path("out") / options.path.stem() : options.out;
  plan.json = options.common.json.empty() ? plan.out / "timings.json" : options.common.json;
  if (auto writable = makeWritableFolder(plan.out); !writable) return writable.error();
  if (auto writable = checkWritableFile(plan.json); !writable) return writable.error();
  if (!options.video.empty()) {
    if (auto writable = checkWritableFile(options.video); !writable) return writable.error();
    if (!haveFfmpeg()) return Error{fmt::format("{}: a video needs the program ffmpeg, which is not on the PATH", options.video.string())};
  }
  return plan;
}

}  // namespace welkin::app
