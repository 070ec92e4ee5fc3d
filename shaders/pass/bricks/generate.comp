// One work group fills one brick: 8^3 corner samples of the density source, and the bounds of what was stored.
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/tree_block.glsl.h"
#include "lib/brick_image.glsl"
#include SOURCE_SHADER

layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = WK_BRICK_JOBS_BINDING) readonly buffer Jobs { GpuBrickJob jobs[]; };
layout(std430, binding = WK_BRICK_RESULTS_BINDING) buffer Results { GpuBrickResult results[]; };
layout(std140, binding = WK_TREE_BINDING) uniform TreeUniforms { TreeBlock tree; };
uniform uint u_firstJob;

void main() {
  uint id = u_firstJob + gl_WorkGroupID.x;
  GpuBrickJob job = jobs[id];
  uvec3 corner = uvec3(job.x, job.y, job.z);
  float low = 1.0, high = 0.0, lowest = uintBitsToFloat(kAltitudeNoneMin), highest = 0.0;
  float margin_m = tree.stepLength_m * levelSteps(job.level) * (1.7320508 / 7.0);  // trilinear data reaches one voxel's diagonal
  prepareSource(corner, job.level, gl_LocalInvocationIndex);
  float density[8] = sourceColumn(corner, job.level, gl_LocalInvocationID.xy);
  for (uint z = 0u; z < 8u; ++z) {
    uvec3 i = uvec3(gl_LocalInvocationID.xy, z);
    uvec3 p = brickSample(corner, job.level, i);
    float value = clamp(density[z] / tree.maxExtinction_per_m, 0.0, 1.0);
    value = floor(value * BRICK_STEPS + 0.5) / BRICK_STEPS;  // what is kept
    storeTexel(tree, job.brick, i, vec2(value, 0.0));
    low = min(low, value);
    high = max(high, value);
    if (value > 0.0) {
      float altitude = float(length(dvec3(p) / tree.stepsPerMetre - tree.half_m) - double(tree.planetRadius_m));
      lowest = min(lowest, max(altitude - margin_m + kAltitudeBias, 0.0));
      highest = max(highest, altitude + margin_m + kAltitudeBias);
    }
  }
  atomicMin(results[id].minBits, floatBitsToUint(low));
  if (high > 0.0) {
    atomicMax(results[id].maxBits, floatBitsToUint(high));
    atomicMin(results[id].minAltitudeBits, floatBitsToUint(lowest));
    atomicMax(results[id].maxAltitudeBits, floatBitsToUint(highest));
  }
}
