// Test: density of a cloud source at positions and levels.
#include SOURCE_SHADER
layout(local_size_x = 64) in;
layout(std430, binding = 8) readonly buffer Inputs { uvec4 places[]; };  // position, level
layout(std430, binding = 9) writeonly buffer Answers { float answers[]; };

void main() {
  uvec4 place = places[gl_GlobalInvocationID.x];
  answers[gl_GlobalInvocationID.x] = sourceDensity(place.xyz, place.w);
}
