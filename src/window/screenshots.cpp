#include "screenshots.h"

#include "welkin/app/checksum.h"
#include "welkin/app/draw.h"
#include "welkin/app/geographic.h"
#include "welkin/app/places.h"

namespace welkin::window {
namespace {

Result<std::filesystem::path> newFile(const std::filesystem::path& folder, const app::PictureState& state,
                                      const std::vector<std::string>& extensions) {
  std::string name = app::shotName(app::localNow(), app::toGeographic(state.view, state.scene.planet.radius_m));
  if (state.debug != DebugView::None) name += fmt::format("-debug-{}", kDebugViewNames[std::size_t(state.debug)]);
  return app::reserveFiles(folder, name, extensions);
}

std::filesystem::path with(std::filesystem::path stem, const char* extension) { return stem += extension; }

}  // namespace

Screenshots::Screenshots(std::filesystem::path folder, std::string gpu)
    : folder_(folder.empty() ? std::filesystem::path(".") : std::move(folder)), gpu_(std::move(gpu)), thread_([this] { work(); }) {}

Screenshots::~Screenshots() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  more_.notify_one();
  thread_.join();
}

void Screenshots::add(std::function<Result<std::string>()> job) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  more_.notify_one();
}

void Screenshots::takeAsSeen(Image8 image, app::PictureState state) {
  add([this, image = std::move(image), state = std::move(state)]() mutable -> Result<std::string> {
    state.data = app::dataChecksums(state.scene);
    const auto file = newFile(folder_, state, {".png"});
    if (!file) return file.error();
    if (auto written = app::writePng(with(*file, ".png"), image, app::textsFromState(state, folder_)); !written) return written.error();
    return "wrote " + with(*file, ".png").string();
  });
}

void Screenshots::takeConverged(const Scene& scene, const View& view, app::Size size, double time_s) {
  add([this, scene, view, size, time_s]() -> Result<std::string> {
    RenderSettings settings;
    settings.width = size.width, settings.height = size.height;
    settings.onlyView = view;
    settings.time_s = time_s;
    auto stage = app::openStage(scene, settings, gpu_);
    if (!stage) return stage.error();
    const auto stats = app::drawConverged(*stage->renderer, view, [this](double) { return !stop_; });
    if (!stats) return stats.error();
    const auto state = app::stateOf(*stage->renderer, view, stats->exposure_ev, size, time_s, true, app::dataChecksums(scene));
    const auto texts = app::textsFromState(state, folder_);
    const auto file = newFile(folder_, state, {".png", ".exr"});
    if (!file) return file.error();
    if (auto written = app::writePng(with(*file, ".png"), stage->renderer->image(), texts); !written) return written.error();
    if (auto written = app::writeExr(with(*file, ".exr"), stage->renderer->radiance(), texts); !written) return written.error();
    return "wrote " + with(*file, ".png").string() + " and .exr, converged";
  });
}

std::vector<Screenshots::Note> Screenshots::news() {
  const std::lock_guard lock(mutex_);
  return std::exchange(notes_, {});
}

bool Screenshots::busy() const {
  const std::lock_guard lock(mutex_);
  return working_ || !jobs_.empty();
}

void Screenshots::work() {
  for (;;) {
    std::unique_lock lock(mutex_);
    more_.wait(lock, [this] { return stop_ || !jobs_.empty(); });
    if (jobs_.empty()) return;
    const auto job = std::move(jobs_.front());
    jobs_.pop_front();
    working_ = true;
    lock.unlock();
    const auto done = job();
    lock.lock();
    working_ = false;
    notes_.push_back({done ? *done : done.error().message, !done});
  }
}

}  // namespace welkin::window
