// Which pixel an invocation of a march is for, in groups of 8 x 8.
// Work groups run down strips two groups wide, so that neighbours find each other's bricks in the cache. Neighbouring invocations are a
// 4 x 2 tile of pixels, not a row: they are run together, and their rays stay alike for longer.
ivec2 tilePixel() {
  uint order = gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x, strip = order / (2u * gl_NumWorkGroups.y);
  uint inStrip = order - strip * 2u * gl_NumWorkGroups.y, wide = min(2u, gl_NumWorkGroups.x - 2u * strip);
  uvec2 group = uvec2(2u * strip + inStrip % wide, inStrip / wide);
  uint i = gl_LocalInvocationIndex;
  return ivec2(group * 8u + uvec2((i & 3u) | ((i >> 1u) & 4u), ((i >> 2u) & 1u) | ((i >> 3u) & 6u)));
}
