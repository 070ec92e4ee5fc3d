#include "welkin/clouds/opaque_deck.h"

namespace welkin {

std::optional<OpaqueDeck> opaqueDeck(const Scene& scene) {
  // Straight down. A march ends at 6.2 (kOpaqueTransmittance); voxels smear the top by up to two and a half of theirs, and what shines
  // through thrice that is 1e-9.
  constexpr double kDeckDepth = 20;
  if (!scene.clouds || scene.clouds->sources.size() != 1) return {};
  const auto* slab = std::get_if<SlabSource>(&scene.clouds->sources.front());
  if (!slab || !(slab->extinction_per_m * (slab->top_m - slab->base_m) > kDeckDepth)) return {};
  return OpaqueDeck{slab->top_m, slab->top_m - kDeckDepth / slab->extinction_per_m};
}

}  // namespace welkin
