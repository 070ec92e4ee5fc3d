#pragma once
// The octree's root cube in the planet frame: centred on the planet, enclosing the cloud shell. 2^32 fixed-point steps an axis.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace welkin {

inline constexpr double kCloudShell_m = 20'000;  // the octree's root reaches this far above the ground

struct RootFrame {
  double planetRadius_m = 0;
  double half_m = 0;  // half the cube's edge

  static RootFrame enclosing(double planetRadius_m, double cloudTop_m) {
    return {planetRadius_m, (planetRadius_m + cloudTop_m) * 1.001};
  }
  double step_m() const { return half_m * 0x1p-31; }              // about 3 mm for an Earth
  double stepsPerMetre() const { return 0x1p31 / half_m; }
  double nodeSize_m(std::uint32_t level) const { return std::ldexp(2 * half_m, -static_cast<int>(level)); }
  // Position of step p (its low corner), planet frame, metres.
  glm::dvec3 toPlanet(glm::uvec3 p) const { return glm::dvec3(p) * step_m() - half_m; }
  // Nearest fixed-point position; outside the cube it is clamped to it.
  glm::uvec3 toFixed(glm::dvec3 x_planet) const {
    const glm::dvec3 s = (x_planet + half_m) * stepsPerMetre();
    const auto one = [](double v) { return static_cast<std::uint32_t>(std::clamp(std::floor(v), 0.0, 4294967295.0)); };
    return {one(s.x), one(s.y), one(s.z)};
  }
};

}  // namespace welkin
