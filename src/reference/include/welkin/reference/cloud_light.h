#pragma once
// The light model of shared/cloud_light.glsl.h in double precision: floats would end an adaptive quadrature at 1e-7. A test compares both.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "welkin/shared/cloud_light.glsl.h"

namespace welkin::reference {

// Optical depth from its stored form, and back.
inline double decodeDepth(double encoded) { return double(shared::kDepthScale) * encoded / std::max(1 - encoded, 1e-4); }
inline double encodeDepth(double depth) { return depth / (depth + double(shared::kDepthScale)); }

inline double henyeyGreenstein(double c, double g) {
  const double a = (1 - g) * (1 - g) + 2 * g * (1 - c);
  return (1 - g * g) / (4 * std::numbers::pi * a * std::sqrt(a));
}
// The shared constants as the decimal numbers that they are meant to be.
inline constexpr double kForwardG = 0.85, kBackwardG = -0.3, kForwardShare = 0.87, kDiffuseGain = 2.2;
inline double cloudPhase(double cosTheta, double sharpness) {
  return (1 - kForwardShare) * henyeyGreenstein(cosTheta, kBackwardG * sharpness) +
         kForwardShare * henyeyGreenstein(cosTheta, kForwardG * sharpness);
}

// What a point's light depends on besides its sun depth: constant along a ray.
struct CloudPhases {
  double single, second, third;
};
inline CloudPhases cloudPhases(double cosTheta) { return {cloudPhase(cosTheta, 1), cloudPhase(cosTheta, 0.6), cloudPhase(cosTheta, 0.35)}; }

inline double skyShare(double encoded) { return 1 - encoded; }
inline double sunSource(const CloudPhases& phases, double encoded) {
  const double quarter = std::exp(-0.25 * decodeDepth(encoded)), half = quarter * quarter;
  const double diffuse = kDiffuseGain / (4 * std::numbers::pi) * (1 - 0.8 * half) * skyShare(encoded);
  return phases.single * half * half + phases.second * half + phases.third * quarter + diffuse;
}
inline double skySource(double openOpacity) { return openOpacity * (0.5 / std::numbers::pi); }
inline double groundSource(double opacity, double openOpacity) { return (opacity - 0.75 * openOpacity) * (0.5 / std::numbers::pi); }

}  // namespace welkin::reference
