// The resident octree as passes read it: maps near the camera and of the whole root, node buffer below them, bricks.
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/tree_block.glsl.h"

layout(std140, binding = WK_TREE_BINDING) uniform TreeUniforms { TreeBlock tree; };
layout(std430, binding = WK_NODES_BINDING) readonly buffer NodeBuffer { uvec2 nodes[]; };
layout(binding = WK_MAP_UNIT) uniform usampler3D u_maps;
layout(binding = WK_BRICK_UNIT) uniform sampler3D u_bricks[BRICK_TEXTURES];

// The node that holds position p at `level` or at the deepest resident level above: from the map of `mapLevel`, then down the node
// buffer. The word's level is the node's own.
uint lookUp(uvec3 p, uint level, uint mapLevel) {
  uint from = min(level, mapLevel);
  uvec3 cell = p >> (32u - from);
  uvec2 entry = texelFetch(u_maps, ivec3(cell.x & 63u, cell.y & 63u, (cell.z & 63u) + (from - tree.mapBase) * 64u), 0).xy;
  uint at = from;
  while (at < level && entry.y != kNoGroup) {
    entry = nodes[entry.y + childOctant(p, at)];
    at++;
    entry.x |= at << 27u;
    if (wordEmpty(entry.x)) break;
  }
  return entry.x;
}

// Density fraction and encoded sun depth at `cells` (0..7 an axis) of a brick.
vec2 sampleBrick(uint brick, vec3 cells) {
  vec3 scale = vec3(1.0 / float(kAtlasX * 8u), 1.0 / float(kAtlasY * 8u), tree.atlasDepthInverse);
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
