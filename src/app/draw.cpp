#include "welkin/app/draw.h"

#include <glad/gl.h>

#include "welkin/app/build_info.h"
#include "welkin/clouds/default_layers.h"
#include "welkin/core/log.h"
#include "welkin/core/units.h"
#include "welkin/gpu/timer.h"

namespace welkin::app {

Result<Stage> openStage(const Scene& scene, const RenderSettings& settings, const std::string& gpuChoice) {
  Stage stage;
  auto context = gpu::Context::createHeadless(gpuChoice);
  if (!context) return context.error();
  stage.context = std::move(*context);
  const auto& device = stage.context->device();
  log::info("OpenGL: {} ({}){}", device.renderer, device.version, device.software ? ", software: no GPU is used" : "");
  auto renderer = Renderer::create(*stage.context, scene, settings);
  if (!renderer) {  // whichever part did not fit: what helps is the least budget that does
    const auto least = leastBudget(*stage.context, scene);
    if (!least || scene.quality.budget_bytes >= *least) return renderer.error();
    return Error{fmt::format("budget: {} is too little for this scene at depth {}: the least that works is {} MiB",
                             bytesText(scene.quality.budget_bytes), scene.quality.depth, *least >> 20)};
  }
  stage.renderer = std::move(*renderer);
  for (const auto& note : stage.renderer->notes()) log::warn("{}", note);
  return stage;
}

Result<FrameStats> drawConverged(Renderer& renderer, const View& view, const std::function<bool(double)>& progress) {
  bool stopped = false;
  renderer.settle(view, [&](double fraction) {
    stopped = progress && !progress(fraction);
    return !stopped;
  });
  if (stopped) return Error{"stopped before the picture was whole"};
  return renderer.frame(view, FrameMode::Full);
}

PictureTime timePicture(Renderer& renderer, const View& view) {
  const double wall0 = gpu::wall_ms(), cpu0 = gpu::processCpu_ms();
  const FrameCounters counters = renderer.preview(view);
  glFinish();
  return {gpu::wall_ms() - wall0, gpu::processCpu_ms() - cpu0, counters};
}

void describeDevice(const gpu::Context& context, measure::ReportContext& out) {
  out.glRenderer = context.device().renderer;
  out.glVersion = context.device().version;
  out.glVendor = context.device().vendor;
  out.software = context.device().software;
}

PictureState stateOf(const Renderer& renderer, const View& view, double exposure_ev, Size size, double time_s, bool converged,
                     const std::map<std::filesystem::path, std::string>& data) {
  PictureState state;
  state.scene = renderer.scene();
  if (state.scene.clouds) {  // layers that the scene left to the program: a later version may have others
    for (auto& source : state.scene.clouds->sources) {
      auto* layers = std::get_if<LayersSource>(&source);
      if (layers != nullptr && layers->layers.empty()) layers->layers = defaultEarthLayers();
    }
  }
  state.view = view;
  state.width = size.width;
  state.height = size.height;
  state.time_s = time_s;
  state.converged = converged;
  state.debug = renderer.debugView();
  state.exposure_ev = exposure_ev;
  if (!state.scene.output.exposure_ev) state.view.exposure_ev = exposure_ev;
  state.build = buildText();
  state.data = data;
  return state;
}

}  // namespace welkin::app
