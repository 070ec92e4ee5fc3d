// Test: the samples of bricks of a cloud source, one brick for each work group.
#include SOURCE_SHADER
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = 8) readonly buffer Inputs { uvec4 bricks[]; };  // corner, level
layout(std430, binding = 9) writeonly buffer Answers { float answers[]; };

void main() {
  uvec4 brick = bricks[gl_WorkGroupID.x];
  prepareSource(brick.xyz, brick.w, gl_LocalInvocationIndex);
  float density[8] = sourceColumn(brick.xyz, brick.w, gl_LocalInvocationID.xy);
  for (uint z = 0u; z < 8u; ++z)
    answers[512u * gl_WorkGroupID.x + gl_LocalInvocationID.x + 8u * (gl_LocalInvocationID.y + 8u * z)] = density[z];
}
