#pragma once
// The cloud as its source makes it, without voxels: density point by point, and the sun's optical depth by a ray of its own from there.
#include <array>
#include <optional>

#include "welkin/clouds/density_source.h"
#include "welkin/reference/cloud_march.h"
#include "welkin/reference/detail.h"

namespace welkin::reference {

struct SourceSettings {
  DetailRule detail;  // band limit by distance from `eye`: the tree's own, or infinite reach and a depth for that level everywhere
  glm::dvec3 eye_planet{};
  glm::dvec3 towardsSun{0, 0, 1};
  double shadowVoxels = 1;  // length of a piece of a ray to the sun: two Gauss points each
};

// Walks straight through the source, over nodes that its bounds show to be empty. Distances from the start.
class SourceWalk {
 public:
  SourceWalk(const DensitySource& source, const RootFrame& root, const SourceSettings& settings, glm::dvec3 start_planet,
             glm::dvec3 direction);

  struct Piece {
    double to;  // where it ends, after t and at most at the end
    bool empty;
    double greatest_per_m;  // no density of the piece is above it
  };
  // On to the end of an empty node, or of the level of detail, or a number of voxels on.
  Piece enter(double t, double end, double voxels);
  // The same by nodes alone, as large as their bounds are tight enough to draw collisions from.
  Piece enterNode(double t, double end);
  // Another ray through the same source: what is known of nodes stays.
  void restart(glm::dvec3 start_planet, glm::dvec3 direction);
  double density(double t) const;  // 1/m

 private:
  struct Known {
    glm::uvec3 corner;
    Bounds bounds;
  };
  Bounds boundsAt(glm::uvec3 p, std::uint32_t level);
  Piece piece(double t, double end, double voxels, double thin);

  const DensitySource& source_;
  const RootFrame& root_;
  const SourceSettings& settings_;
  glm::dvec3 start_, direction_;
  std::array<std::optional<Known>, shared::kMaxDepth + 1> known_;  // of the nodes that hold the last point, by level
};

class SourceField final : public CloudField {
 public:
  SourceField(const DensitySource& source, const RootFrame& root, const SourceSettings& settings);  // keeps references to source and root
  Stretch stretchOf(const CameraRay& ray) const override;
  std::unique_ptr<CloudAlong> along(const CameraRay& ray, double from_m) const override;
  glm::dvec3 towardsSun() const override { return settings_.towardsSun; }
  std::uint64_t contentHash() const override;
  // Optical depth from a point towards the sun, at most kOpaqueDepth, which it is behind the planet too.
  double sunDepth(glm::dvec3 position_planet) const;
  // Of the whole lines through a point, along the sun's direction and upright: farther away than kChordReach_m and a node nothing counts.
  glm::dvec2 chords(glm::dvec3 position_planet, double sunDepth) const;
  // Optical depth of a ray up to where it leaves the clouds, meets the ground, or to a distance.
  double opticalDepth(const CameraRay& ray, double most_m) const;

 private:
  double halfChord(glm::dvec3 position_planet, glm::dvec3 direction) const;
  double depthWithin(SourceWalk& walk, Stretch stretch, double most) const;

  const DensitySource& source_;
  const RootFrame& root_;
  SourceSettings settings_;
};

inline constexpr double kOpaqueDepth = 200, kChordReach_m = 32e3;  // as the light pass has them

}  // namespace welkin::reference
