#include "welkin/clouds/sphere_source.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace welkin {

SphereCloud::SphereCloud(const SphereSource& sphere, const RootFrame& root) {
  const glm::uvec3 centre = root.toFixed(sphere.centre_m);
  params_ = {centre.x, centre.y, centre.z, static_cast<float>(sphere.radius_m * root.stepsPerMetre()),
             static_cast<float>(sphere.extinction_per_m)};
  const double altitude = glm::length(sphere.centre_m) - root.planetRadius_m;
  base_m_ = altitude - sphere.radius_m;
  top_m_ = altitude + sphere.radius_m;
}

std::vector<std::uint32_t> SphereCloud::shaderParams() const {
  std::vector<std::uint32_t> words(sizeof(params_) / 4);
  std::memcpy(words.data(), &params_, sizeof(params_));
  return words;
}

Bounds SphereCloud::bounds(glm::uvec3 corner, std::uint32_t level) const {
  const double size = std::ldexp(1.0, 32 - static_cast<int>(level));
  const double centre[3] = {static_cast<double>(params_.centreX), static_cast<double>(params_.centreY),
                            static_cast<double>(params_.centreZ)};
  double near2 = 0, far2 = 0;
  for (int i = 0; i < 3; ++i) {
    const double a = static_cast<double>(corner[i]) - centre[i], b = a + size;
    const double near = a > 0 ? a : b < 0 ? -b : 0, far = std::max(std::abs(a), std::abs(b));
    near2 += near * near;
    far2 += far * far;
  }
  // The edge narrows with the level from a voxel to a tenth of the radius: the widest and the narrowest one bound all between.
  const double radius = static_cast<double>(params_.radius_steps);
  const double narrow = 0.1 * radius, wide = std::max(narrow, size / 7);
  const auto value = [&](double d, double edge) { return std::clamp((0.95 * radius + 0.5 * edge - d) / edge, 0.0, 1.0); };
  const double near = std::sqrt(near2), far = std::sqrt(far2), slack = 1e-6;  // float distance against double
  const double hi = std::max(value(near, narrow), value(near, wide)), lo = std::min(value(far, narrow), value(far, wide));
  if (hi <= 0) return {};
  if (lo >= 1) return {params_.extinction_per_m, params_.extinction_per_m};
  return {params_.extinction_per_m * static_cast<float>(std::max(0.0, lo - slack)),
          params_.extinction_per_m * static_cast<float>(std::min(1.0, hi + slack))};
}

}  // namespace welkin
