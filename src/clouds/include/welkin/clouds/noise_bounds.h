#pragma once
// Intervals of noise over dyadic boxes.
#include <glm/glm.hpp>

#include "welkin/shared/noise.glsl.h"

namespace welkin {

struct Interval {
  float lo = 0, hi = 0;
};

// noise3 over the box of 2^sizeShift steps at `corner` (a multiple of it), far side included. A box that is no larger than the noise
// cell lies inside one, so its eight gradients are known: value at the centre, and the slope from these gradients alone. Larger boxes
// get the whole range.
Interval noiseInterval(glm::uvec3 corner, std::uint32_t sizeShift, std::uint32_t shift, std::uint32_t zShift, std::uint32_t seed);

// The same with billowNoise on top.
Interval billowInterval(Interval noise, float billow);

}  // namespace welkin
