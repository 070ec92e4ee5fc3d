// The resident octree as passes read it: maps near the camera and of the whole root, node buffer below them, bricks.
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/tree_block.glsl.h"

layout(std140, binding = WK_TREE_BINDING) uniform TreeUniforms { TreeBlock tree; };
layout(binding = WK_TREE_UNIT) uniform usamplerBuffer u_tree;
layout(binding = WK_BRICK_UNIT) uniform sampler3D u_bricks[BRICK_TEXTURES];
layout(binding = WK_CHORDS_UNIT) uniform usamplerBuffer u_chords;

// The node that holds position p at `level` or at the deepest resident level above: from the map of `mapLevel` (from the root, for a
// level above the coarsest map), then down the nodes. The word's level is the node's own.
struct Found {
  uint word, parent;  // the parent's if the way down began above `level`: at most at `from`
};
Found lookUp(uvec3 p, uint level, uint from, uint mapLevel) {
  bool fromRoot = from < tree.mapBase;
  uint at = fromRoot ? 0u : min(from, mapLevel);
  uint index = fromRoot ? tree.firstNode : mapEntry(p >> (32u - at), at, tree.mapBase);
  uvec2 entry = texelFetch(u_tree, int(index)).xy;   // a map entry carries its level, the root has level 0
  uint parent = entry.x;
  while (at < level && entry.y != kNoGroup && !wordEmpty(entry.x)) {
    parent = entry.x;
    entry = texelFetch(u_tree, int(tree.firstNode + entry.y + childOctant(p, at))).xy;
    at++;
    entry.x |= at << 27u;
  }
  return Found(entry.x, parent);
}
uint lookUp(uvec3 p, uint level, uint mapLevel) { return lookUp(p, level, level, mapLevel).word; }

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

// Encoded optical depths of the cloud's chords, along the sun's line and upright, at `cells` of a brick: trilinear between its corners.
vec2 sampleChords(uint brick, vec3 cells) {
  uvec4 low = texelFetch(u_chords, int(2u * brick)), high = texelFetch(u_chords, int(2u * brick + 1u));
  vec3 f = clamp(cells, 0.0, 7.0) * (1.0 / 7.0);
  vec4 y0 = mix(vec4(unpackUnorm2x16(low.x), unpackUnorm2x16(high.x)), vec4(unpackUnorm2x16(low.y), unpackUnorm2x16(high.y)), f.x);
  vec4 y1 = mix(vec4(unpackUnorm2x16(low.z), unpackUnorm2x16(high.z)), vec4(unpackUnorm2x16(low.w), unpackUnorm2x16(high.w)), f.x);
  vec4 z = mix(y0, y1, f.y);
  return mix(z.xy, z.zw, f.z);
}
