// Writing and reading single texels of bricks.
#include "welkin/shared/tree_block.glsl.h"
#ifndef BRICK_FORMAT  // what the tree keeps; rg8 and 255.0 for comparisons (docs/decisions/0012)
#define BRICK_FORMAT rg16
#define BRICK_STEPS 65535.0
#endif
layout(BRICK_FORMAT, binding = 0) uniform image3D u_brickImage[BRICK_TEXTURES];

void storeTexel(TreeBlock tree, uint brick, uvec3 i, vec2 value) {
#if BRICK_TEXTURES > 1
  uint index = brick / tree.bricksPerTexture;
  ivec3 at = ivec3(brickTexel(brick - index * tree.bricksPerTexture) + i);
  for (uint n = 0u; n < BRICK_TEXTURES; ++n)
    if (index == n) imageStore(u_brickImage[n], at, vec4(value, 0.0, 0.0));
#else
  imageStore(u_brickImage[0], ivec3(brickTexel(brick) + i), vec4(value, 0.0, 0.0));
#endif
}

vec2 loadTexel(TreeBlock tree, uint brick, uvec3 i) {
#if BRICK_TEXTURES > 1
  uint index = brick / tree.bricksPerTexture;
  ivec3 at = ivec3(brickTexel(brick - index * tree.bricksPerTexture) + i);
  for (uint n = 0u; n + 1u < BRICK_TEXTURES; ++n)
    if (index == n) return imageLoad(u_brickImage[n], at).rg;
  return imageLoad(u_brickImage[BRICK_TEXTURES - 1], at).rg;
#else
  return imageLoad(u_brickImage[0], ivec3(brickTexel(brick) + i)).rg;
#endif
}
