// A list of pixels that a later pass marches, made by work groups of 8 x 8. A group's entries stay together, in an order in which neighbours in
// the list are neighbours in the picture: their rays are marched together, and stay alike for longer.
#include "welkin/shared/bindings.glsl.h"
layout(std430, binding = WK_PIXELS_BINDING) buffer PixelList { uint groups, one, one_, count, pixels[]; };

const uint kListGroup = 64u;  // entries of a work group of the march
const uint kMostListed = 192u;
shared uint s_listed[kMostListed];
shared uint s_listCount, s_listBase;

// Of an invocation in its group: a Z curve, 4 x 2 for every eight.
ivec2 listPlace() {
  uint i = gl_LocalInvocationIndex;
  return ivec2((i & 1u) | ((i >> 1u) & 2u) | ((i >> 2u) & 4u), ((i >> 1u) & 1u) | ((i >> 2u) & 2u) | ((i >> 3u) & 4u));
}

void beginList() {
  if (gl_LocalInvocationIndex == 0u) s_listCount = 0u;
  barrier();
}

// At most three by each invocation.
void listPixel(ivec2 pixel) { s_listed[atomicAdd(s_listCount, 1u)] = uint(pixel.x) | (uint(pixel.y) << 16u); }

// Returns how many the group has listed.
uint endList() {
  barrier();
  if (gl_LocalInvocationIndex == 0u && s_listCount > 0u) {
    s_listBase = atomicAdd(count, s_listCount);
    uint more = (s_listBase + s_listCount + kListGroup - 1u) / kListGroup - (s_listBase + kListGroup - 1u) / kListGroup;
    if (more > 0u) atomicAdd(groups, more);
  }
  barrier();
  for (uint i = gl_LocalInvocationIndex; i < s_listCount; i += kListGroup) pixels[s_listBase + i] = s_listed[i];
  return s_listCount;
}
