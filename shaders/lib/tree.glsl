// The resident octree as passes read it: maps near the camera and of the whole root, node buffer below them, bricks.
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/tree_block.glsl.h"

layout(std140, binding = WK_TREE_BINDING) uniform TreeUniforms { TreeBlock tree; };
layout(binding = WK_TREE_UNIT) uniform usamplerBuffer u_tree;
layout(binding = WK_BRICK_UNIT) uniform sampler3D u_bricks[BRICK_TEXTURES];

// The node that holds position p at `level` or at the deepest resident level above: from the map of `mapLevel`, then down the nodes.
// The word's level is the node's own. Loops end with their condition: software GL runs a loop's body once however it begins.
uint lookUp(uvec3 p, uint level, uint mapLevel) {
  uint at = min(level, mapLevel);
  uint index = mapEntry(p >> (32u - at), at, tree.mapBase);
  uint known = 0xFFFFFFFFu;   // a map entry carries its level
  uvec2 entry;
  bool deeper;
  do {
    entry = texelFetch(u_tree, int(index)).xy;
    entry.x = (entry.x & 0x07FFFFFFu) | (known == 0xFFFFFFFFu ? entry.x & 0xF8000000u : known << 27u);
    deeper = at < level && entry.y != kNoGroup && !wordEmpty(entry.x);
    index = tree.firstNode + entry.y + childOctant(p, at);
    at++;
    known = at;
  } while (deeper);
  return entry.x;
}

vec3 atlasScale() { return vec3(1.0 / float(kAtlasX * 8u), 1.0 / float(kAtlasY * 8u), tree.atlasDepthInverse); }

// Density fraction and encoded sun depth at `cells` (0..7 an axis) of a brick.
vec2 sampleBrick(uint brick, vec3 cells) {
  vec3 scale = atlasScale();
  cells = clamp(cells, 0.0, 7.0) + 0.5;
#if BRICK_TEXTURES > 1
  uint index = brick / tree.bricksPerTexture;
  vec3 at = (vec3(brickTexel(brick - index * tree.bricksPerTexture)) + cells) * scale;
  for (uint i = 0u; i + 1u < BRICK_TEXTURES; ++i)
    if (index == i) return textureLod(u_bricks[i], at, 0.0).rg;
  return textureLod(u_bricks[BRICK_TEXTURES - 1], at, 0.0).rg;
#else
  return textureLod(u_bricks[0], (vec3(brickTexel(brick)) + cells) * scale, 0.0).rg;
#endif
}
