#pragma once
// The steps that commands share once a scene is chosen: open the GL, make a renderer, draw one pose to its end.
#include <functional>
#include <memory>

#include "welkin/app/options.h"
#include "welkin/render/renderer.h"

namespace welkin::app {

struct Stage {  // members in the order of need: the renderer goes before its context
  std::unique_ptr<gpu::Context> context;
  std::unique_ptr<Renderer> renderer;
};

// Opens the GL and says in a log line which one; notes of the renderer become log lines.
Result<Stage> openStage(const Scene& scene, const RenderSettings& settings, const std::string& gpuChoice);

// Residency settled, then every pixel marched: the picture that `welkin render` shows. Error only when `progress` stopped it.
Result<FrameStats> drawConverged(Renderer& renderer, const View& view, const std::function<bool(double)>& progress = {});

// Times of one picture of the tree as it is, until the GL has finished. The worker has nothing to do meanwhile.
struct PictureTime {
  double wall_ms, cpu_ms;
  FrameCounters counters;  // what its rays met
};
PictureTime timePicture(Renderer& renderer, const View& view);

void describeDevice(const gpu::Context& context, measure::ReportContext& out);

// State for a picture of this renderer's scene that will lie at `picture`. exposure_ev: at which it is shown (FrameStats); a metered
// one becomes the view's own, so that the picture comes back equal.
PictureState stateOf(const Renderer& renderer, const View& view, double exposure_ev, Size size, double time_s, bool converged,
                     const std::map<std::filesystem::path, std::string>& data);

}  // namespace welkin::app
