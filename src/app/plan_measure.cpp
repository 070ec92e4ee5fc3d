#include "plan_measure.h"

#include <glad/gl.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "welkin/measure/statistics.h"

namespace welkin::app {
namespace {

constexpr std::uint64_t kBrickBytes = 512 * 4;  // 8^3 samples of RG16
constexpr int kStillFrames = 20;                // one pixel in 16 a frame, and edits on their way: until a still picture is whole

struct Series {
  std::vector<double> start_ms, frame_ms;
  double bytes = 0;
  Image8 image;
};

// On software GL the process is alone with its threads' work; on a GPU only the wall clock sees the device.
double clock_ms(const gpu::Context& context) {
  glFinish();
  return context.device().software ? gpu::processCpu_ms() : gpu::wall_ms();
}

// Until the worker has done what the last frame gave it: the next frame's time is then its own.
void restWorker() {
  for (int i = 0; i < 1000; ++i) {
    const double before = gpu::processCpu_ms();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    if (gpu::processCpu_ms() - before < 0.3) return;
  }
}

double bytesInUse(const Renderer& renderer, const FrameStats& stats) {
  const auto& byName = renderer.memory().byName();
  const auto pool = byName.find("bricks");
  const std::uint64_t all = renderer.memory().used() + renderer.memory().frameTargets();
  return double(all - (pool == byName.end() ? 0 : pool->second) + (pool == byName.end() ? 0 : stats.residency.bricks * kBrickBytes));
}

Result<void> takeTurn(gpu::Context& context, const Start& start, const RenderSettings& settings, FrameMode mode, int frames, Series& out) {
  const double begin = clock_ms(context);
  auto made = Renderer::create(context, start.scene, settings);
  if (!made) return made.error();
  Renderer& renderer = **made;
  FrameStats stats = renderer.settle(start.view);
  stats = renderer.frame(start.view, FrameMode::Full);
  out.start_ms.push_back(clock_ms(context) - begin);
  for (int i = 0; mode == FrameMode::Reprojected && i < kStillFrames; ++i) stats = renderer.frame(start.view, mode);
  for (int i = 0; i < frames; ++i) {
    restWorker();
    const double from = clock_ms(context);
    stats = renderer.frame(start.view, mode);
    out.frame_ms.push_back(clock_ms(context) - from);
  }
  out.bytes = bytesInUse(renderer, stats);
  out.image = renderer.image();
  return {};
}

int greatestDifference(const Image8& a, const Image8& b) {
  int most = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) most = std::max(most, std::abs(int(a.rgba[i]) - int(b.rgba[i])));
  return most;
}

}  // namespace

double Saving::most() const { return std::max({start_ms.saved(), frame_ms.saved(), bytes.saved()}); }

Result<Saving> measureReason(gpu::Context& context, const Start& start, const PlanFor& asked, const LeftOut& reason,
                             const MeasureSettings& how) {
  RenderSettings settings;
  settings.width = how.size.width, settings.height = how.size.height;
  settings.timing = false;
  settings.time_s = start.time_s;
  settings.linear = asked.linear;
  settings.forced = asked.forced;
  if (asked.onePicture) settings.onlyView = asked.view;
  RenderSettings forced = settings;
  forced.forced.insert(reason.name);
  const FrameMode mode = asked.onePicture ? FrameMode::Full : FrameMode::Reprojected;
  Series with, without;
  for (int turn = 0; turn <= how.turns; ++turn) {
    if (auto done = takeTurn(context, start, settings, mode, how.frames, with); !done) return done.error();
    if (auto done = takeTurn(context, start, forced, mode, how.frames, without); !done) return done.error();
    if (turn == 0)  // compiles what the driver keeps on disk, and reads files that the system keeps in memory
      for (Series* s : {&with, &without}) s->start_ms.clear(), s->frame_ms.clear();
  }
  const auto median = [](const std::vector<double>& v) { return measure::summarize(v).median; };
  Saving saving{reason, !asked.onePicture, {}, {}, {}};
  saving.start_ms = {median(with.start_ms), median(without.start_ms)};
  saving.frame_ms = {median(with.frame_ms), median(without.frame_ms)};
  saving.bytes = {with.bytes, without.bytes};
  saving.maxDifference_255 = greatestDifference(with.image, without.image);
  return saving;
}

}  // namespace welkin::app
