#include "welkin/render/sky/sky_tables.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <span>
#include <string>

#include "welkin/physics/air.h"
#include "welkin/shared/bindings.glsl.h"

namespace welkin {
namespace {

using namespace shared;

gpu::Defines layerDefines(const AirBlock& block) {
  gpu::Defines defines{{"AIR_LAYERS", std::to_string(std::max(block.params.layerCount, 1u))}};
  defines.emplace_back("AIR_PEAK_LAYER", std::to_string(static_cast<int>(block.params.peakLayer)));
  for (std::size_t i = 0; i < kMaxAirLayers; ++i) {
    defines.emplace_back("AIR_PROFILE_" + std::to_string(i), std::to_string(block.layers[i].profile) + "u");
    defines.emplace_back("AIR_PHASE_" + std::to_string(i), std::to_string(block.layers[i].phase) + "u");
  }
  return defines;
}

void tablesWritten() { glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT); }

}  // namespace

Result<SkyTables> SkyTables::create(gpu::MemoryAccount& account, const Scene& scene) {
  auto block = airBlock(scene);
  if (!block) return block.error();
  SkyTables tables;
  tables.block_ = *block;
  double scale_m = 8000;  // Rayleigh air, if no layer says anything else
  for (const auto& layer : scene.atmosphere->layers)
    if (const auto* e = std::get_if<ExponentialProfile>(&layer.profile)) scale_m = std::min(scale_m, e->scaleHeight_m);
  tables.altitudeStep_m_ = scale_m / 1000;
  if (auto r = tables.allocate(account); !r) return r.error();
  if (auto r = tables.compute(); !r) return r.error();
  return tables;
}

Result<void> SkyTables::allocate(gpu::MemoryAccount& account) {
  const auto make = [&](gpu::Texture& out, GLenum format, std::uint32_t width, std::uint32_t height, std::uint32_t depth) -> Result<void> {
    gpu::TextureSpec spec;
    spec.target = depth > 1 ? GL_TEXTURE_3D : GL_TEXTURE_2D;
    spec.format = format;
    spec.width = static_cast<int>(width), spec.height = static_cast<int>(height), spec.depth = static_cast<int>(depth);
    auto texture = gpu::Texture::create(account, "sky", spec);
    if (!texture) return texture.error();
    out = std::move(*texture);
    return {};
  };
  const std::uint32_t view = kViewGroundTexels + kViewSkyTexels;
  if (auto r = make(transmittance_, GL_RGBA32F, kTransmittanceWidth, kTransmittanceHeight, 1); !r) return r;
  if (auto r = make(multiple_, GL_RGBA32F, kSunTexels, kAltitudeTexels, 1); !r) return r;
  if (auto r = make(irradiance_, GL_RGBA32F, kSunTexels, 2 * kAltitudeTexels, 1); !r) return r;
  if (auto r = make(scatter_, GL_RGBA16F, view, kViewAzimuths, 2 * kViewSlices); !r) return r;
  if (auto r = make(depth_, GL_RGBA16F, view, kViewSlices, 1); !r) return r;
  auto buffer = gpu::Buffer::create(account, "sky", sizeof(AirBlock));
  if (!buffer) return buffer.error();
  params_ = std::move(*buffer);
  params_.upload(0, std::as_bytes(std::span(&block_, 1)));
  return {};
}

Result<void> SkyTables::compute() {
  const gpu::Defines defines = layerDefines(block_);
  // One dispatch for each value of `facing`.
  const auto run = [&](const char* path, std::initializer_list<float> facing, const gpu::Texture& target, unsigned x,
                       unsigned y) -> Result<void> {
    auto program = gpu::Program::compute(path, defines);
    if (!program) return program.error();
    target.bindImage(0, GL_WRITE_ONLY);
    for (const float f : facing) {
      program->set("u_facing", f);
      program->dispatch(x, y);
      tablesWritten();
    }
    return {};
  };
  params_.bind(GL_UNIFORM_BUFFER, WK_AIR_PARAMS_BINDING);
  transmittance_.bind(WK_SKY_TRANSMITTANCE_UNIT);
  irradiance_.bind(WK_SKY_IRRADIANCE_UNIT);
  multiple_.bind(WK_SKY_VIEW_TRANSMITTANCE_UNIT);  // read while tables are made, before anybody looks along a view
  if (auto r = run("pass/sky/transmittance.comp", {0.0f}, transmittance_, kTransmittanceWidth / 8, kTransmittanceHeight / 8); !r) return r;
  if (auto r = run("pass/sky/multiple.comp", {0.0f}, multiple_, kSunTexels / 8, kAltitudeTexels / 4); !r) return r;
  if (auto r = run("pass/sky/irradiance.comp", {1.0f, -1.0f}, irradiance_, kSunTexels / 8, kAltitudeTexels / 4); !r) return r;
  auto view = gpu::Program::compute("pass/sky/view.comp", defines);
  if (!view) return view.error();
  viewProgram_ = std::move(*view);
  return {};
}

bool SkyTables::updateView(const CameraBlock& camera, glm::dvec3 toSun) {
  const double altitude = std::max(camera.position.w, 0.0);
  const glm::dvec3 up = xyz(camera.position) / camera.up.w;
  // Rounded so that the step follows the altitude but is the same for all poses that round alike: powers of two.
  const double wanted = std::max(altitudeStep_m_, altitude / 2000);
  const double step = std::exp2(std::floor(std::log2(wanted)));
  const double keyAltitude = std::round(altitude / step) * step;
  const double keyCosSun = std::round(glm::dot(up, toSun) * 0x1p15) * 0x1p-15;
  block_.view = airViewFrame(block_.params, camera.up.w, altitude, up, toSun);
  const bool stale = keyAltitude != keyAltitude_m_ || keyCosSun != keyCosSun_;
  params_.bind(GL_UNIFORM_BUFFER, WK_AIR_PARAMS_BINDING);
  if (stale) {
    keyAltitude_m_ = keyAltitude, keyCosSun_ = keyCosSun;
    // The tables are made for the rounded pose; look-ups use the exact one, so the horizon stays where it is.
    const bool inside = altitude <= block_.params.top_m;
    const double made = inside ? std::min<double>(keyAltitude, block_.params.top_m)
                               : std::max<double>(keyAltitude, std::nextafter(block_.params.top_m, 1e9f));
    AirBlock rounded = block_;
    const glm::dvec3 side{block_.view.axisX, block_.view.axisY, block_.view.axisZ};
    const double c = std::clamp(keyCosSun, -1.0, 1.0);
    rounded.view = airViewFrame(block_.params, camera.forward.w + made, made, up, up * c + side * std::sqrt(1 - c * c));
    params_.upload(0, std::as_bytes(std::span(&rounded, 1)));
    transmittance_.bind(WK_SKY_TRANSMITTANCE_UNIT);
    multiple_.bind(WK_SKY_VIEW_TRANSMITTANCE_UNIT);
    scatter_.bindImage(0, GL_WRITE_ONLY);
    depth_.bindImage(1, GL_WRITE_ONLY);
    viewProgram_.dispatch((kViewGroundTexels + kViewSkyTexels) / 8, kViewAzimuths / 4);
    tablesWritten();
  }
  params_.upload(0, std::as_bytes(std::span(&block_, 1)));
  return stale;
}

void SkyTables::bind() const {
  params_.bind(GL_UNIFORM_BUFFER, WK_AIR_PARAMS_BINDING);
  params_.bind(GL_SHADER_STORAGE_BUFFER, WK_AIR_PARAMS_BINDING);
  transmittance_.bind(WK_SKY_TRANSMITTANCE_UNIT);
  irradiance_.bind(WK_SKY_IRRADIANCE_UNIT);
  scatter_.bind(WK_SKY_VIEW_SCATTER_UNIT);
  depth_.bind(WK_SKY_VIEW_TRANSMITTANCE_UNIT);
}

std::size_t SkyTables::bytes() const {
  return params_.bytes() + transmittance_.bytes() + multiple_.bytes() + irradiance_.bytes() + scatter_.bytes() + depth_.bytes();
}

}  // namespace welkin
