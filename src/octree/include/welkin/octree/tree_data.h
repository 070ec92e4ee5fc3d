#pragma once
// The resident tree as the GPU holds it at one moment, copied to plain memory: what rays see, for whoever wants to look again.
#include <array>
#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <vector>

#include "welkin/shared/tree_block.glsl.h"

namespace welkin {

struct TreeData {
  shared::TreeBlock block{};
  std::vector<shared::NodeWords> nodes;            // the root, then groups of eight
  std::vector<std::vector<std::uint16_t>> bricks;  // by texture: texels as stored, x fastest, of each density and light
  // By brick, at its corners, x fastest: optical depth, as stored, of the whole lines along the sun's direction and upright (shared/cloud_light)
  std::vector<std::array<glm::u16vec2, 8>> chords;
};

}  // namespace welkin
