#include "welkin/render/exposure/exposure_pass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "welkin/render/tone_curve.h"
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/exposure.glsl.h"

namespace welkin {
namespace {

unsigned groups(int pixels, int size) { return static_cast<unsigned>((pixels + size - 1) / size); }

// The power of two at or below the sun's irradiance: a division by it is exact. 1 without a sun.
double unitOfLight(const Scene& scene) {
  if (!scene.sun) return 1;
  const auto& e = scene.sun->irradiance;
  const double greatest = std::max({e[0], e[1], e[2]});
  return greatest > 0 ? std::exp2(std::floor(std::log2(greatest))) : 1;
}

// Share of the way that is gone after dt; a time constant of 0 goes it at once.
float share(double dt_s, double constant_s) { return constant_s > 0 ? static_cast<float>(-std::expm1(-dt_s / constant_s)) : 1.0f; }

}  // namespace

float exposureScale(double ev) { return static_cast<float>(shared::kBaseExposure * std::exp2(ev)); }

Result<ExposurePass> ExposurePass::create(gpu::MemoryAccount& account, const Scene& scene) {
  ExposurePass pass;
  pass.settings_ = scene.output.autoExposure;
  const double unit = unitOfLight(scene);
  pass.unitInverse_ = static_cast<float>(1 / unit);
  pass.offset_ev_ =
      static_cast<float>(std::log2(middleGrey(scene.output.toneCurve) / (shared::kBaseExposure * unit)) + pass.settings_.compensation_ev);
  const gpu::Defines curve{{"TONE_CURVE", toneCurveFunction(scene.output.toneCurve)}};
  for (const auto& [program, path, defines] :
       {std::tuple{&pass.histogram_, "histogram", gpu::Defines{}}, {&pass.adapt_, "adapt", gpu::Defines{}}, {&pass.show_, "show", curve}}) {
    auto made = gpu::Program::compute(std::string("pass/exposure/") + path + ".comp", defines);
    if (!made) return made.error();
    *program = std::move(*made);
  }
  auto block = gpu::Buffer::create(account, "exposure", sizeof(shared::ExposureBlock));
  if (!block) return block.error();
  pass.block_ = std::move(*block);
  shared::ExposureBlock start{};
  start.adapted_ev = static_cast<float>(std::clamp(0.0, pass.settings_.min_ev, pass.settings_.max_ev));
  for (shared::uint i = 0; i < shared::kEvSteps; ++i) start.stepScale[i] = exposureScale(double(i) / shared::kEvSteps);
  pass.block_.upload(0, std::as_bytes(std::span(&start, 1)));
  return pass;
}

void ExposurePass::meter(const gpu::Texture& radiance, double sinceLast_s) {
  const double dt_s = std::max(sinceLast_s, 0.0);
  const auto& size = radiance.spec();
  block_.bind(GL_SHADER_STORAGE_BUFFER, WK_EXPOSURE_BINDING);
  radiance.bindImage(0, GL_READ_ONLY);
  histogram_.set("u_size", glm::ivec2(size.width, size.height));
  histogram_.set("u_unitInverse", unitInverse_);
  histogram_.dispatch(groups(size.width, 16), groups(size.height, 16));
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  adapt_.set("u_percentiles", glm::vec2(settings_.lowPercentile, settings_.highPercentile) / 100.0f);
  adapt_.set("u_limits_ev", glm::vec2(settings_.min_ev, settings_.max_ev));
  adapt_.set("u_offset_ev", offset_ev_);
  adapt_.set("u_towards", glm::vec2(share(dt_s, settings_.adaptToBright_s), share(dt_s, settings_.adaptToDark_s)));
  adapt_.dispatch(1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  metered_ = true;
}

void ExposurePass::show(const gpu::Texture& radiance, const gpu::Texture& display, std::optional<double> ev) const {
  const auto& size = radiance.spec();
  block_.bind(GL_SHADER_STORAGE_BUFFER, WK_EXPOSURE_BINDING);
  radiance.bindImage(0, GL_READ_ONLY);
  display.bindImage(1, GL_WRITE_ONLY);
  show_.set("u_size", glm::ivec2(size.width, size.height));
  show_.set("u_fixedScale", ev ? exposureScale(*ev) : 0.0f);
  show_.dispatch(groups(size.width, 8), groups(size.height, 8));
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

double ExposurePass::reached_ev() const {
  float ev = 0;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  block_.download(offsetof(shared::ExposureBlock, ev), std::as_writable_bytes(std::span(&ev, 1)));
  return ev;
}

}  // namespace welkin
