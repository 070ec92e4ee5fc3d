#pragma once
// Layered procedural clouds, over a cover map or under full cover everywhere.
#include <optional>

#include "welkin/clouds/cover_map.h"
#include "welkin/clouds/density_source.h"
#include "welkin/shared/cloud_source.glsl.h"

namespace welkin {

class LayeredClouds final : public DensitySource {
 public:
  LayeredClouds(const std::vector<CloudLayer>& layers, std::optional<CoverMap> cover, const RootFrame& root, std::uint32_t seed,
                std::string note);
  // A uniform shell.
  static std::unique_ptr<DensitySource> slab(const SlabSource& slab, const RootFrame& root);

  Bounds bounds(glm::uvec3 corner, std::uint32_t level) const override;
  float density(glm::uvec3 p, std::uint32_t level) const override;
  float maxExtinction() const override;
  std::uint32_t emptyFrom() const override;
  double base_m() const override { return static_cast<double>(block_.header.lowest_m); }
  double top_m() const override { return static_cast<double>(block_.header.highest_m); }
  std::string shader() const override { return "lib/clouds/layers.glsl"; }
  std::vector<std::uint32_t> shaderParams() const override;
  std::string note() const override { return note_; }

  const shared::CloudBlock& block() const { return block_; }
  shared::SourceView view() const;

 private:
  struct Box;
  Bounds layerBounds(std::uint32_t layer, const Box& box) const;
  void noiseBounds(const shared::CloudLayerParams& layer, const Box& box, float& lo, float& hi) const;

  RootFrame root_;
  shared::CloudBlock block_{};
  std::optional<CoverMap> cover_;
  // By layer and level: what the softened ramp of any deeper level may reach beyond the interval of the noise, in noise units.
  std::vector<float> slackHigh_, slackLow_;
  std::string note_;
};

}  // namespace welkin
