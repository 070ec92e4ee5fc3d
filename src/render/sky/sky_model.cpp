#include "welkin/render/sky/sky_model.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "welkin/physics/air.h"

namespace welkin {

namespace {

// Scattering optical depth of the longest path there is, the one that touches the ground, both ways out; the greatest of the three
// wavelengths. Each layer as if it were full up to its thickness: a bound of the order of the true value.
double longestDepth(const Scene& scene) {
  const double top_m = airTop_m(scene);
  Spectrum3 sum{0, 0, 0};
  for (const AirLayer& l : scene.atmosphere->layers) {
    const double h = std::min(layerThickness_m(l), top_m);
    const double path = 2 * std::sqrt(h * (2 * scene.planet.radius_m + h));
    for (std::size_t c = 0; c < 3; ++c) sum[c] += l.scattering_per_m[c] * path;
  }
  return *std::max_element(sum.begin(), sum.end());
}

constexpr double kThin = 1e-3;  // what such air adds by scattering once is 1/1000 of white ground; scattering twice is beyond 16 bits

}  // namespace

Result<SkyModel> skyModel(const Scene& scene, bool everyHarmonic) {
  const auto air = airBlock(scene);
  if (!air) return air.error();
  const bool peaked = everyHarmonic || std::any_of(std::begin(air->layers), std::begin(air->layers) + air->params.layerCount, isPeaked);
  SkyModel m;
  m.name = scene.atmosphere->model;
  m.reason = "the scene asks for it";
  if (m.name == "auto" && longestDepth(scene) < kThin) {
    m.name = "march", m.reason = "auto: the air is so thin that nothing is seen that was scattered twice";
  } else if (m.name == "auto") {
    m.name = "tables-4d", m.reason = "auto: the air stays as it is, so the most exact is paid once";
  }
  // Measured: docs/decisions/0011.
  if (m.name == "tables-4d") {
    m.degree = peaked ? 4 : 2, m.zonal = peaked ? 12 : 2;
    m.sunTexels = 48, m.altitudeTexels = 22;
    m.above = 7, m.below = 4, m.azimuths = 7;
    m.peakAngles = 12, m.peakAzimuths = 6;
    m.pieces = 9;
    m.maxOrders = 40, m.rest = 1e-3;
  } else if (m.name == "tables-2d") {
    m.degree = m.zonal = 2;
    m.sunTexels = 32, m.altitudeTexels = 16;
    m.above = 4, m.below = 4, m.azimuths = 4;
    m.peakAngles = 6, m.peakAzimuths = 4;
    m.pieces = 6;
    m.maxOrders = 20, m.rest = 1e-2;
  } else if (m.name == "march") {
    m.maxOrders = 1;
    m.sunTexels = m.altitudeTexels = 2;
  } else {
    return Error{"atmosphere: model must be auto, tables-4d, tables-2d or march, found " + m.name};
  }
  return m;
}

}  // namespace welkin
