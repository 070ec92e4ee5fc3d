#pragma once
// The resident tree as the GPU holds it at one moment, copied to plain memory: what rays see, for whoever wants to look again.
#include <cstdint>
#include <vector>

#include "welkin/shared/tree_block.glsl.h"

namespace welkin {

struct TreeData {
  shared::TreeBlock block{};
  std::vector<shared::NodeWords> nodes;            // the root, then groups of eight
  std::vector<std::vector<std::uint16_t>> bricks;  // by texture: texels as stored, x fastest, of each density and light
};

}  // namespace welkin
