#pragma once
// Level of detail by distance in double precision: shared/tree_block.glsl.h's detailAt before it is rounded.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "welkin/shared/tree_block.glsl.h"

namespace welkin::reference {

// A ray samples level L up to `reach_m` / 2^L away, nothing finer than `depth`, and nearer than `near_m` as at that distance.
struct DetailRule {
  double reach_m = std::numeric_limits<double>::infinity();  // K times the root's edge; infinite: the deepest level everywhere
  std::uint32_t depth = 0;
  double near_m = 0;

  std::uint32_t level(double distance_m) const {
    const double reach = std::max(reach_m / std::max(distance_m, near_m), 1.0);
    return reach >= std::ldexp(1.0, int(depth)) ? depth : std::uint32_t(std::ilogb(reach));
  }
  // How much of the parent is mixed into a level at a distance that samples it.
  double parentWeight(std::uint32_t level, double distance_m) const {
    if (level == 0) return 0;
    const double r = std::ldexp(std::max(reach_m / std::max(distance_m, near_m), 1.0), -int(level));
    return std::clamp((1 - double(shared::kFadeStart) * r) / (1 - double(shared::kFadeStart)), 0.0, 1.0);
  }
  // The next distance after this one at which the rule is not smooth: where the parent begins to fade in, where the level ends.
  double nextBreak(std::uint32_t level, double distance_m) const {
    if (level == 0) return std::numeric_limits<double>::infinity();
    if (distance_m < near_m) return near_m;
    const double far_m = std::ldexp(reach_m, -int(level)), fade_m = far_m * double(shared::kFadeStart);
    return distance_m < fade_m ? fade_m : far_m;
  }
};

}  // namespace welkin::reference
