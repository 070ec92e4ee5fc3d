#include "welkin/render/sky/sky_tables.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "welkin/physics/air.h"
#include "welkin/render/sky/sky_field.h"
#include "welkin/shared/bindings.glsl.h"

namespace welkin {
namespace {

using namespace shared;

gpu::Defines layerDefines(const AirBlock& block, const SkyModel& model) {
  gpu::Defines defines{{"AIR_LAYERS", std::to_string(std::max(block.params.layerCount, 1u))},
                       {"AIR_PEAK_LAYER", std::to_string(static_cast<int>(block.params.peakLayer))},
                       {"FIELD_DEGREE", std::to_string(model.degree)},
                       {"FIELD_ZONAL", std::to_string(model.zonal)}};
  unsigned peaked = 0;
  for (std::size_t i = 0; i < kMaxAirLayers; ++i) {
    const shared::AirLayer& layer = block.layers[i];
    const bool scatters = i < block.params.layerCount && layer.scatteringR + layer.scatteringG + layer.scatteringB > 0;
    const int degree = layer.phase == kPhaseIsotropic ? 0 : layer.phase == kPhaseRayleigh ? 2 : model.zonal;
    if (i < block.params.layerCount && isPeaked(layer)) peaked |= 1u << i;
    defines.emplace_back("AIR_PROFILE_" + std::to_string(i), std::to_string(layer.profile) + "u");
    defines.emplace_back("AIR_PHASE_" + std::to_string(i), std::to_string(layer.phase) + "u");
    defines.emplace_back("AIR_DEGREE_" + std::to_string(i), std::to_string(scatters ? degree : -1));
  }
  defines.emplace_back("AIR_PEAKED", std::to_string(peaked));
  return defines;
}

constexpr int kAllRows = 1 << 20;

void tablesWritten() { glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT); }

}  // namespace

Result<SkyTables> SkyTables::create(gpu::MemoryAccount& account, const Scene& scene, SkyOrders orders, bool everyHarmonic) {
  auto tables = begin(account, scene, orders, everyHarmonic);
  if (!tables) return tables.error();
  while (tables->advance(kAllRows)) {}
  return tables;
}

Result<SkyTables> SkyTables::empty(gpu::MemoryAccount& account, const Scene& scene, SkyOrders orders, bool everyHarmonic) {
  auto model = skyModel(scene, everyHarmonic);
  if (!model) return model.error();
  if (orders == SkyOrders::First) model->maxOrders = 1, model->degree = model->zonal = 0;
  auto block = airBlock(scene, model->zonal);
  if (!block) return block.error();
  SkyTables tables;
  tables.model_ = *model;
  tables.block_ = *block;
  tables.altitudeStep_m_ = block->params.altitudeScale_m / 1000;
  tables.defines_ = layerDefines(*block, *model);
  if (auto r = tables.allocate(account); !r) return r.error();
  if (auto r = tables.compute(); !r) return r.error();
  return tables;
}

Result<SkyTables> SkyTables::begin(gpu::MemoryAccount& account, const Scene& scene, SkyOrders orders, bool everyHarmonic) {
  auto tables = empty(account, scene, orders, everyHarmonic);
  if (!tables) return tables.error();
  auto field = SkyField::create(account, tables->model_, tables->block_, tables->defines_);
  if (!field) return field.error();
  tables->field_ = std::make_unique<SkyField>(std::move(*field));
  return tables;
}

Result<SkyTables> SkyTables::withField(gpu::MemoryAccount& account, const Scene& scene, SkyTables& from, bool everyHarmonic) {
  auto tables = empty(account, scene, SkyOrders::All, everyHarmonic);
  if (!tables) return tables.error();
  if (tables->model_.moments() != from.model_.moments() || tables->model_.diffuse() != from.model_.diffuse())
    return Error{"the sky's light must be made anew: another model, or other phase functions"};
  tables->field_ = std::move(from.field_);
  return tables;
}

void SkyTables::letGoOfMakers() {
  field_->letGoOfMakers();
  if (discDepth_.id() != 0) pointDepth_ = {};
}

double SkyTables::progress() const { return field_->progress(); }

bool SkyTables::advance(int rows) {
  params_.bind(GL_UNIFORM_BUFFER, WK_AIR_PARAMS_BINDING);
  sunDepth().bind(WK_SKY_TRANSMITTANCE_UNIT);
  const bool more = field_->advance(rows);
  keyAltitude_m_ = -1;  // the view tables show less light than there is
  return more;
}

SkyTables::SkyTables() = default;
SkyTables::SkyTables(SkyTables&&) noexcept = default;
SkyTables& SkyTables::operator=(SkyTables&&) noexcept = default;
SkyTables::~SkyTables() = default;

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
  if (auto r = make(pointDepth_, GL_RGBA32F, kTransmittanceWidth, kTransmittanceHeight, 1); !r) return r;
  if (block_.params.sunRadius_rad > 0)
    if (auto r = make(discDepth_, GL_RGBA32F, kTransmittanceWidth, kTransmittanceHeight, 1); !r) return r;
  if (auto r = make(scatter_, GL_RGBA16F, view, kViewAzimuths, 2 * kViewSlices); !r) return r;
  if (auto r = make(depth_, GL_RGBA16F, view, kViewSlices, 1); !r) return r;
  if (model_.diffuse())
    if (auto r = make(diffuse_, GL_RGBA32F, kDiffuseGroundTexels + kDiffuseSkyTexels, kDiffuseAzimuths, kDiffuseSlices); !r) return r;
  auto buffer = gpu::Buffer::create(account, "sky", sizeof(AirBlock));
  if (!buffer) return buffer.error();
  params_ = std::move(*buffer);
  params_.upload(0, std::as_bytes(std::span(&block_, 1)));
  return {};
}

Result<void> SkyTables::compute() {
  const auto run = [&](const char* path, const gpu::Texture& target) -> Result<void> {
    auto program = gpu::Program::compute(path, defines_);
    if (!program) return program.error();
    target.bindImage(0, GL_WRITE_ONLY);
    program->dispatch(kTransmittanceWidth / 8, kTransmittanceHeight / 8);
    tablesWritten();
    return {};
  };
  params_.bind(GL_UNIFORM_BUFFER, WK_AIR_PARAMS_BINDING);
  if (auto r = run("pass/sky/transmittance.comp", pointDepth_); !r) return r;
  pointDepth_.bind(WK_SKY_TRANSMITTANCE_UNIT);
  if (discDepth_.id() != 0)
    if (auto r = run("pass/sky/sunlight.comp", discDepth_); !r) return r;
  const std::string pieces = block_.params.hazeTop > 0 ? "3" : "1";  // thick air hides most of a path: its light comes from a few slices
  gpu::Defines defines = defines_;
  defines.emplace_back("VIEW_PIECES", pieces);
  defines.insert(defines.end(), {{"SINGLE", "1"}, {"DIFFUSE", "0"}, {"VIEW_DIFFUSE", model_.diffuse() ? "1" : "0"}});
  auto view = gpu::Program::compute("pass/sky/view.comp", defines);
  if (!view) return view.error();
  viewProgram_ = std::move(*view);
  if (!model_.diffuse()) return {};
  defines = defines_;
  defines.emplace_back("VIEW_PIECES", pieces);
  defines.insert(defines.end(), {{"SINGLE", "0"}, {"DIFFUSE", "1"},
                                 {"READ_DEGREE", std::to_string(std::min(model_.degree, 2))},
                                 {"READ_ZONAL", std::to_string(std::min(model_.zonal, 6))}});
  auto diffuse = gpu::Program::compute("pass/sky/view_diffuse.comp", defines);
  if (!diffuse) return diffuse.error();
  diffuseProgram_ = std::move(*diffuse);
  return {};
}

gpu::Defines SkyTables::drawDefines() const {
  gpu::Defines defines = defines_;
  defines.emplace_back("SINGLE", "1");
  defines.emplace_back("DIFFUSE", model_.diffuse() ? "1" : "0");
  return defines;
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
    sunDepth().bind(WK_SKY_TRANSMITTANCE_UNIT);
    field_->bind();
    if (model_.diffuse()) {
      diffuse_.bindImage(0, GL_WRITE_ONLY);
      diffuseProgram_.dispatch((kDiffuseGroundTexels + kDiffuseSkyTexels) / 8, kDiffuseAzimuths / 8);
      tablesWritten();
      diffuse_.bind(WK_SKY_VIEW_SCATTER_UNIT);
    }
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
  sunDepth().bind(WK_SKY_TRANSMITTANCE_UNIT);
  field_->bind();
  scatter_.bind(WK_SKY_VIEW_SCATTER_UNIT);
  depth_.bind(WK_SKY_VIEW_TRANSMITTANCE_UNIT);
}

std::size_t SkyTables::bytes() const {
  return params_.bytes() + pointDepth_.bytes() + discDepth_.bytes() + field_->bytes() + diffuse_.bytes() + scatter_.bytes() + depth_.bytes();
}

}  // namespace welkin
