#include "welkin/render/sky/sky_model.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "welkin/shared/phase.glsl.h"

namespace welkin {

bool SkyModel::peaked(std::uint32_t phase, float g) {
  return (phase == shared::kPhaseCornetteShanks || phase == shared::kPhaseHenyeyGreenstein) && std::abs(g) > 0.3f;
}

Result<SkyModel> skyModel(const Scene& scene) {
  if (!scene.atmosphere) return Error{"the scene has no atmosphere"};
  SkyModel m;
  m.name = scene.atmosphere->model;
  if (m.name == "auto") m.name = "tables-4d", m.reason = "auto: the air does not change";
  else m.reason = "the scene says so";
  const auto isPeaked = [](const AirLayer& l) {
    return (l.phase == PhaseType::CornetteShanks || l.phase == PhaseType::HenyeyGreenstein) && std::abs(l.g) > 0.3;
  };
  const auto& layers = scene.atmosphere->layers;
  const bool peaked = std::any_of(layers.begin(), layers.end(), isPeaked);
  if (m.name == "tables-4d") {
    m.degree = peaked ? 4 : 2, m.zonal = peaked ? 12 : 2;
    m.sunTexels = 64, m.altitudeTexels = 28;
    m.above = 8, m.below = 5, m.azimuths = 8;
    m.peakAngles = 16, m.peakAzimuths = 8;
    m.pieces = 12;
    m.maxOrders = 40, m.rest = 1e-3;
  } else if (m.name == "tables-2d") {
    m.degree = m.zonal = 2;
    m.sunTexels = 32, m.altitudeTexels = 16;
    m.above = 4, m.below = 3, m.azimuths = 4;
    m.peakAngles = 6, m.peakAzimuths = 4;
    m.pieces = 8;
    m.maxOrders = 40, m.rest = 1e-2;
  } else if (m.name == "march") {
    m.maxOrders = 1;
    m.sunTexels = m.altitudeTexels = 2;
  } else {
    return Error{"atmosphere: model must be auto, tables-4d, tables-2d or march, found " + m.name};
  }
  if (const char* t = std::getenv("WKSKY")) std::sscanf(t, "%d,%d,%u,%u,%d,%d,%d,%d,%d,%d,%d,%lf", &m.degree, &m.zonal, &m.sunTexels, &m.altitudeTexels, &m.above, &m.below, &m.azimuths, &m.peakAngles, &m.peakAzimuths, &m.pieces, &m.maxOrders, &m.rest);  // XXX
  return m;
}

}  // namespace welkin
