#pragma once
// A cloud source for tests of tree and streaming: patches of cloud in a shell, cheap and with exact bounds.
#include <algorithm>
#include <cmath>

#include "welkin/clouds/density_source.h"
#include "welkin/shared/octree.glsl.h"

namespace welkin::test {

// Cloud between two altitudes; every column of `patch_m` cubes is cloudy or not by a hash, with a density by another. `holes`:
// density() is zero in more places than bounds() promises, as with a real source.
class FakeSource : public DensitySource {
 public:
  FakeSource(const RootFrame& root, double base_m, double top_m, std::uint32_t patchLevel = 8, std::uint32_t seed = 1)
      : root_(root), base_m_(base_m), top_m_(top_m), patchLevel_(patchLevel), seed_(seed) {}

  Bounds bounds(glm::uvec3 corner, std::uint32_t level) const override {
    const double size = root_.nodeSize_m(level), half = size / 2, voxel = size / 7;
    const glm::dvec3 c = glm::abs(root_.toPlanet(corner) + half);
    const double nearest = glm::length(glm::max(c - half, 0.0)), farthest = glm::length(c + half);
    const double R = root_.planetRadius_m;
    if (farthest < R + base_m_ - voxel || nearest > R + top_m_ + voxel) return {};
    if (level < patchLevel_) return {0, kMax};
    // The far corners of a brick belong to the patch beyond.
    const std::uint32_t mask = shared::levelMask(level);
    float most = 0;
    for (std::uint32_t i = 0; i < 8; ++i) {
      const auto far = [&](std::uint32_t v, std::uint32_t bit) {
        return i >> bit & 1 ? shared::saturatingAdd(v, mask + (mask != 0xFFFFFFFFu)) : v;
      };
      most = std::max(most, patch({far(corner.x, 0), far(corner.y, 1), far(corner.z, 2)}));
    }
    return {0, most};
  }
  float density(glm::uvec3 p, std::uint32_t level) const override {
    const double h = glm::length(root_.toPlanet(p)) - root_.planetRadius_m, voxel = root_.nodeSize_m(level) / 7;
    if (h < base_m_ - voxel * 0.5 || h > top_m_ + voxel * 0.5) return 0;
    if (level < patchLevel_) return kMax * 0.25f;
    return hash(p, 11) % 5 == 0 ? 0 : patch(p) * 0.5f;
  }
  float maxExtinction() const override { return kMax; }
  double base_m() const override { return base_m_; }
  double top_m() const override { return top_m_; }
  std::string shader() const override { return {}; }
  std::vector<std::uint32_t> shaderParams() const override { return {}; }

 private:
  static constexpr float kMax = 0.05f;
  std::uint32_t hash(glm::uvec3 p, std::uint32_t level) const {
    const std::uint32_t shift = 32 - level;
    std::uint32_t h = seed_ * 0x9E3779B9u;
    for (const std::uint32_t v : {p.x >> shift, p.y >> shift, p.z >> shift}) {
      h = (h ^ v) * 0x85EBCA6Bu;
      h ^= h >> 15;
      h *= 0xC2B2AE35u;
      h ^= h >> 13;
    }
    return h;
  }
  float patch(glm::uvec3 p) const {
    const std::uint32_t h = hash(p, patchLevel_);
    return h % 3 == 0 ? 0 : kMax * static_cast<float>(1 + h / 3 % 64) / 64.0f;
  }

  RootFrame root_;
  double base_m_, top_m_;
  std::uint32_t patchLevel_, seed_;
};

}  // namespace welkin::test
