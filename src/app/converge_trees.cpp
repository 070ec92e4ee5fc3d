#include "converge_trees.h"

#include <algorithm>

#include "welkin/app/draw.h"
#include "welkin/app/stop.h"
#include "welkin/core/files.h"
#include "welkin/core/log.h"
#include "welkin/physics/path_io.h"
#include "welkin/physics/scene_io.h"

namespace welkin::app {
namespace {

using measure::ConvergeSetting, measure::Frames;

constexpr std::size_t kFramesBefore = 16;  // one pixel in 16 a frame: older history is gone

// A path is the JSON file that has frames.
bool isPath(const std::filesystem::path& file) {
  const auto text = readFile(file);
  return text && kindOfBytes(*text) == PictureKind::None && text->find("\"frames\"") != std::string::npos;
}

Result<Poses> posesOfPath(const ConvergeOptions& options) {
  auto path = loadPath(options.input);
  if (!path) return path.error();
  auto scene = loadScene(path->scene);
  if (!scene) return scene.error();
  if (auto above = checkPath(*path, scene->planet); !above) return above.error();
  Poses out;
  out.scene = std::move(*scene);
  out.size = {path->width, path->height};
  out.name = path->name.empty() ? options.input.stem().string() : path->name;
  const std::size_t frames = path->frames.size(), count = std::min<std::size_t>(frames, std::size_t(options.poses));
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t frame = (2 * i + 1) * frames / (2 * count);  // in the middle of equal parts
    out.views.push_back(path->frames[frame].view);
    out.times_s.push_back(path->frames[frame].time_s);
    auto& before = out.before.emplace_back();
    for (std::size_t k = frame - std::min(frame, kFramesBefore); k < std::max<std::size_t>(frame, 1); ++k)
      before.push_back(path->frames[k].view);
  }
  return out;
}

}  // namespace

Result<Poses> loadPoses(const ConvergeOptions& options) {
  Poses out;
  if (isPath(options.input)) {
    if (!options.view.empty() || options.common.time_s)
      return Error{fmt::format("{}: a path has its own views and times", options.input.string())};
    auto poses = posesOfPath(options);
    if (!poses) return poses;
    out = std::move(*poses);
  } else {
    auto start = loadStart(options.input, options.view);
    if (!start) return start.error();
    out.scene = std::move(start->scene);
    out.size = start->size;
    out.name = start->viewName;
    out.views = {start->view};
    out.times_s = {options.common.time_s.value_or(start->time_s)};
  }
  if (!out.scene.clouds)
    return Error{fmt::format("{}: expected clouds: without them there is no march to measure", options.input.string())};
  apply(options.common, out.scene);
  for (auto& view : out.views) apply(options.common, view);
  for (auto& frames : out.before)
    for (auto& view : frames) apply(options.common, view);
  if (options.common.size) out.size = *options.common.size;
  return out;
}

Result<void> Trees::openContext() {
  auto context = gpu::Context::createHeadless(gpu_);
  if (!context) return context.error();
  context_ = std::move(*context);
  const auto& device = context_->device();
  log::info("OpenGL: {} ({}){}", device.renderer, device.version, device.software ? ", software: no GPU is used" : "");
  return {};
}

Result<void> Trees::open(const ConvergeSetting& setting) {
  if (trees_.contains(key(setting))) return {};
  Scene scene = scene_;
  scene.quality = setting.quality;
  scene.quality.detail = scene_.quality.detail;  // a setting's own only limits what is sampled
  RenderSettings settings;
  settings.width = size_.width;
  settings.height = size_.height;
  settings.brickBits = setting.brickBits;
  settings.light = setting.light;
  settings.forced = {"nothing-moves"};  // what a frame costs is what is asked
  auto renderer = Renderer::create(*context_, scene, settings);
  if (!renderer) return renderer.error();
  for (const auto& note : (*renderer)->notes()) {
    if (std::find(notes_.begin(), notes_.end(), note) != notes_.end()) continue;
    log::warn("{}", note);
    notes_.push_back(note);
  }
  trees_[key(setting)].renderer = std::move(*renderer);
  return {};
}

Result<void> Trees::settle(const View& view, double time_s, const std::function<bool(double)>& progress) {
  double done = 0;
  for (auto& [key, tree] : trees_) {
    bool stopped = false;
    tree.renderer->setTime(time_s);
    const FrameStats stats = tree.renderer->settle(view, [&](double f) {
      stopped = !progress((done + f) / double(trees_.size()));
      return !stopped;
    });
    if (stopped) return Error{"stopped before the tree was settled"};
    if (std::exchange(tree.fresh, false)) tree.settled = stats;
    done += 1;
  }
  return {};
}

Result<std::vector<ConvergeSetting>> chooseSettings(const ConvergeOptions& options, Poses& poses, Trees& trees) {
  ConvergeSetting base;
  base.quality = poses.scene.quality;
  std::vector<ConvergeSetting> out;
  if (!options.sweep.empty()) {
    out = combine(base, options.sweep);
  } else if (options.preset == "thesis") {
    if (auto opened = trees.open(base); !opened) return opened.error();
    poses.scene.quality.detail = base.quality.detail = trees.of(base).shownDetail(poses.views.front());
    trees.close();
    auto budget = fillingBudget(poses, trees, base);
    if (!budget) return budget.error();
    out = thesisSettings(base, *budget);
  } else {
    out = presetSettings(options.preset, base);
  }
  if (poses.before.empty()) {
    const bool asked = std::any_of(options.sweep.begin(), options.sweep.end(), [](const SweepAxis& a) { return a.name == "frames"; });
    const auto moves = [](const ConvergeSetting& s) { return s.frames == Frames::Moving; };
    if (asked && std::any_of(out.begin(), out.end(), moves))
      return Error{fmt::format("{}: frames=moving needs a path (JSON with frames)", options.input.string())};
    std::erase_if(out, moves);  // of a preset
  }
  return out;
}

}  // namespace welkin::app
