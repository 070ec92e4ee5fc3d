#pragma once
// A ball of cloud, for tests.
#include "welkin/clouds/density_source.h"
#include "welkin/shared/cloud_sphere.glsl.h"

namespace welkin {

class SphereCloud final : public DensitySource {
 public:
  SphereCloud(const SphereSource& sphere, const RootFrame& root);
  Bounds bounds(glm::uvec3 corner, std::uint32_t level) const override;
  float density(glm::uvec3 p, std::uint32_t level) const override { return shared::sphereDensity(params_, p, level); }
  float maxExtinction() const override { return params_.extinction_per_m; }
  double base_m() const override { return base_m_; }
  double top_m() const override { return top_m_; }
  std::string shader() const override { return "lib/clouds/sphere.glsl"; }
  std::vector<std::uint32_t> shaderParams() const override;

 private:
  shared::SphereParams params_{};
  double base_m_, top_m_;
};

}  // namespace welkin
