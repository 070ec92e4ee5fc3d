// Test: noise and the light of clouds.
#include "welkin/shared/cloud_light.glsl.h"
#include "welkin/shared/noise.glsl.h"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { uvec4 places[]; };  // position, seed
layout(std430, binding = 1) writeonly buffer Answers { uint answers[]; };

void main() {
  uint row = gl_GlobalInvocationID.x, o = 16u * row;
  uvec4 x = places[row];
  uint shift = 1u + x.w % 31u, zShift = 1u + (x.w >> 8u) % 31u;
  answers[o] = mixBits(x.x);
  answers[o + 1u] = latticeX(x.x, shift, 1u);
  answers[o + 2u] = latticeY(x.y, shift, 0u);
  answers[o + 3u] = latticeZ(x.z, zShift, 1u);
  float n = noise3(x.xyz, shift, zShift, x.w);
  float cosine = float(x.x >> 8u) / 8388608.0 - 1.0, encoded = float(x.y >> 8u) / 16777216.0;
  CloudPhases phases = cloudPhases(cosine);
  CloudSlab slab = cloudSlab(float(x.z >> 8u) / 1048576.0, float(x.w >> 8u) / 1048576.0, 0.5 * cosine, 0.3, cosine);
  float floats[10] = float[10](cellFraction(x.x, shift), n, billowNoise(n, 0.7), phases.single, phases.broad, openShare(20.0 * encoded, slab),
    sunSource(phases, 20.0 * encoded, slab), skySource(encoded), groundSource(1.0, encoded), cloudShadow(encoded * 20.0));
  for (uint i = 0u; i < 10u; ++i) answers[o + 4u + i] = floatBitsToUint(floats[i]);
}
