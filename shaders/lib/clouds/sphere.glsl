// One ball of cloud (tests).
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/cloud_sphere.glsl.h"
layout(std430, binding = WK_SOURCE_PARAMS_BINDING) readonly buffer SourceParams { SphereParams sourceSphere; };
void prepareSource(uvec3 corner, uint level, uint index) {}
float[8] sourceColumn(uvec3 corner, uint level, uvec2 xy) {
  float density[8];
  for (uint k = 0u; k < 8u; ++k) density[k] = sphereDensity(sourceSphere, brickSample(corner, level, uvec3(xy, k)), level);
  return density;
}
