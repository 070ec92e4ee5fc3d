#pragma once
// The cloud that a ray sees in the resident tree: its bricks, trilinear, at the level of detail that distance asks for.
#include "welkin/octree/tree_data.h"
#include "welkin/reference/cloud_march.h"
#include "welkin/reference/detail.h"

namespace welkin::reference {

// Which level a point is seen at, and how much of its parent is blended in: by its own distance; or, as the march does it, by the distance
// at which the ray enters the node, for all of the node. The difference is an error of the march that no step takes away.
enum class Fade { Smooth, ByNode };

class TreeField final : public CloudField {
 public:
  explicit TreeField(const TreeData& data, Fade fade = Fade::Smooth);  // keeps a reference
  Stretch stretchOf(const CameraRay& ray) const override;
  std::unique_ptr<CloudAlong> along(const CameraRay& ray, double from_m) const override;
  glm::dvec3 towardsSun() const override { return glm::normalize(glm::dvec3(data_.block.sunDir)); }

  std::uint64_t contentHash() const override;

  // The node that holds a fixed-point position at a level, or the deepest one above it; brick, greatest value and its own level.
  struct Node {
    std::uint32_t brick, level;
    bool empty;
    double greatest;  // bound of its subtree, as a share of the greatest extinction
  };
  Node lookUp(glm::uvec3 p, std::uint32_t level) const;
  // Density, as a share of the greatest, and light of a brick's corner sample (0..7 an axis).
  glm::dvec2 texel(std::uint32_t brick, glm::uvec3 i) const;
  // Chords as stored at `cells` of a brick, 0..7 an axis: trilinear between its corners.
  glm::dvec2 chords(std::uint32_t brick, glm::dvec3 cells) const;

  const TreeData& data() const { return data_; }
  const DetailRule& detail() const { return detail_; }
  Fade fade() const { return fade_; }

 private:
  const TreeData& data_;
  Fade fade_;
  DetailRule detail_;
};

// Everything that the field depends on, and nothing that only says where it is stored: two trees with the same key look the same to rays.
std::uint64_t contentHash(const TreeData& data);

}  // namespace welkin::reference
