// Layered procedural clouds, with or without a cover map. ONE_LAYER: there is one, whatever the type of the weather.
#include "welkin/shared/cloud_column.glsl.h"

shared float s_cover[64], s_type[64];
shared uint s_coverHigh, s_typeLow, s_typeHigh, s_layers;

// Once a brick, by all 64 invocations: the weather on its lattice, and which layers can reach it.
void prepareSource(uvec3 corner, uint level, uint index) {
#if !ONE_LAYER
  if (index == 0u) {
    s_coverHigh = 0u;
    s_typeHigh = 0u;
    s_typeLow = 0x3F800000u;
    s_layers = 0u;
  }
  barrier();
#endif
  uvec3 at = weatherPoint(corner, level, uvec3(index & 3u, (index >> 2u) & 3u, index >> 4u));
#if ONE_LAYER
  s_cover[index] = cloudCover(at, level);
  barrier();
#else
  Weather weather = weatherAt(at, level);
  s_cover[index] = weather.cover;
  s_type[index] = weather.type;
  atomicMax(s_coverHigh, floatBitsToUint(weather.cover));
  atomicMax(s_typeHigh, floatBitsToUint(weather.type));
  atomicMin(s_typeLow, floatBitsToUint(weather.type));
  barrier();
  if (index < kMaxCloudLayers) {
    // altitudes from the nearest and the farthest point of the brick
    dvec3 low = dvec3(corner) - dvec3(2147483648.0), high = low + double(levelSteps(level));
    dvec3 near = max(max(low, -high), dvec3(0.0)), far = max(abs(low), abs(high));
    double radius2 = doubleFromWords(sourceHeader.radius2Low, sourceHeader.radius2High);
    double near2 = dot(near, near), far2 = dot(far, far);
    float a = float(near2 - radius2) / (sqrt(float(near2)) + sourceHeader.radius_steps) * sourceHeader.step_m - 0.05;
    float b = float(far2 - radius2) / (sqrt(float(far2)) + sourceHeader.radius_steps) * sourceHeader.step_m + 0.05;
    if (index < sourceHeader.layerCount && layerReaches(index, level, max(max(a, -b), 0.0), max(abs(a), abs(b)), uintBitsToFloat(s_coverHigh),
                                                        uintBitsToFloat(s_typeLow), uintBitsToFloat(s_typeHigh)))
      atomicOr(s_layers, 1u << index);
  }
  barrier();
#endif
}

// Extinctions in 1/m of the eight samples along z from sample (x, y, 0) of the brick.
float[8] sourceColumn(uvec3 corner, uint level, uvec2 xy) {
  uvec3 p = brickSample(corner, level, uvec3(xy, 0u));
  vec2 at = vec2(xy) * (3.0 / 7.0);
  uvec2 i = min(uvec2(at), uvec2(2u));
  vec2 f = at - vec2(i);
  uint base = i.x + 4u * i.y;
  float coverPlane[4];
#if !ONE_LAYER
  float typePlane[4];
#endif
  for (uint z = 0u; z < 4u; ++z) {
    uint k = base + 16u * z;
    coverPlane[z] = mix(mix(s_cover[k], s_cover[k + 1u], f.x), mix(s_cover[k + 4u], s_cover[k + 5u], f.x), f.y);
#if !ONE_LAYER
    typePlane[z] = mix(mix(s_type[k], s_type[k + 1u], f.x), mix(s_type[k + 4u], s_type[k + 5u], f.x), f.y);
#endif
  }
  Column8 steps, height, cover, type, density;
  for (uint k = 0u; k < 8u; ++k) {
    uvec3 q = brickSample(corner, level, uvec3(xy, k));
    steps.v[k] = float(q.z - p.z);
    height.v[k] = abs(cloudAltitude(q));
    float z = float(k) * (3.0 / 7.0);
    uint j = min(k * 3u / 7u, 2u);
    cover.v[k] = mix(coverPlane[j], coverPlane[j + 1u], z - float(j));
#if ONE_LAYER
    type.v[k] = 0.0;
#else
    type.v[k] = mix(typePlane[j], typePlane[j + 1u], z - float(j));
#endif
    density.v[k] = 0.0;
  }
#if ONE_LAYER
  density = layerColumn(density, 0u, p, level, steps, height, cover, type);
#else
  uint layers = s_layers;
  bool any = layers != 0u;
  do {
    uint layer = any ? uint(findLSB(layers)) : 0u;
    layers &= layers - 1u;
    density = layerColumn(density, layer, p, level, steps, height, cover, type);
  } while (any && layers != 0u);
  if (!any)
    for (uint k = 0u; k < 8u; ++k) density.v[k] = 0.0;
#endif
  return density.v;
}
