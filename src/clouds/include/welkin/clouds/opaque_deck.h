#pragma once
// A deck of cloud without a gap, through which nothing is seen.
#include <optional>

#include "welkin/physics/scene.h"

namespace welkin {

struct OpaqueDeck {
  double top_m;    // a camera above it
  double floor_m;  // sees nothing below it
};

// From higher up voxels are as thick as the deck is, and what is below it may shine through: there it does not count.
inline constexpr double kDeckSeenFrom_m = 50'000;

// None in doubt. Layers have gaps wherever the weather has no cloud at all; a slab has none.
std::optional<OpaqueDeck> opaqueDeck(const Scene& scene);

}  // namespace welkin
