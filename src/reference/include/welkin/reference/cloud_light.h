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
inline constexpr double kForwardG = 0.85, kBackwardG = -0.3, kForwardShare = 0.87, kAsymmetry = 0.7005, kSimilar = 0.2995, kBroadened = 0.7,
                        kLeastSlant = 0.05;
inline double cloudPhase(double cosTheta, double sharpness) {
  return (1 - kForwardShare) * henyeyGreenstein(cosTheta, kBackwardG * sharpness) +
         kForwardShare * henyeyGreenstein(cosTheta, kForwardG * sharpness);
}

// What a point's light depends on besides its depths: constant along a ray.
struct CloudPhases {
  double single, broad;
};
inline CloudPhases cloudPhases(double cosTheta) { return {cloudPhase(cosTheta, 1), cloudPhase(cosTheta, kBroadened)}; }

inline double ownChord(double extinction_per_m, double voxel_m) { return double(shared::kOwnVoxels) * extinction_per_m * voxel_m; }
struct CloudSlab {
  double slant, depth, normal;
};
inline CloudSlab cloudSlab(double sunChord, double upChord, double muSun, double muView, double cosTheta) {
  const double deck = std::clamp(muSun, kLeastSlant, 1.0), slant = std::clamp(upChord / std::max(sunChord, 1e-12), deck, 1.0);
  const double ball = (slant - deck) / std::max(1 - deck, 1e-12);
  return {slant, kSimilar * slant * sunChord, muView + (cosTheta - muView) * ball};
}

inline double openShare(double tau, const CloudSlab& slab) {
  return (0.5 + 0.75 * std::max(slab.depth - kSimilar * slab.slant * tau, 0.0)) / (1 + 0.75 * slab.depth);
}
inline double sunSource(const CloudPhases& phases, double tau, const CloudSlab& slab) {
  const double direct = std::exp(-tau), beam = std::exp(-kSimilar * tau), through = std::exp(-slab.depth / slab.slant);
  const double open = openShare(tau, slab), steep = 0.75 * slab.slant;
  const double mean = (0.5 + steep) * open - steep * beam - (0.5 - steep) * through * (1 - open);
  const double net = (0.5 + steep + (0.5 - steep) * through) / (1 + 0.75 * slab.depth) - beam;
  const double diffuse = std::max(mean + 0.75 * kAsymmetry * net * slab.normal, 0.0) * slab.slant / std::numbers::pi;
  return phases.single * direct + phases.broad * (beam - direct) + diffuse;
}
inline double skySource(double openOpacity) { return openOpacity / std::numbers::pi; }
inline double groundSource(double opacity, double openOpacity) { return (opacity - openOpacity) / std::numbers::pi; }

}  // namespace welkin::reference
