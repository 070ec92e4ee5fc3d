// Logarithm of the optical depth of the air from every altitude and direction to the top of the shell.
#include "welkin/shared/air.glsl.h"
#include "welkin/shared/bindings.glsl.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = WK_AIR_PARAMS_BINDING) uniform AirUniforms { AirBlock u_air; };
layout(rgba32f, binding = 0) uniform writeonly image2D u_out;

void main() {
  vec2 size = vec2(kTransmittanceWidth, kTransmittanceHeight);
  vec2 point = transmittancePoint(u_air.params, vec2(gl_GlobalInvocationID.xy) / (size - 1.0));
  vec3 depth = airOpticalDepthToTop(u_air, point.x, point.y, 28u);
  imageStore(u_out, ivec2(gl_GlobalInvocationID.xy), vec4(log(max(depth, vec3(kNoDepth))), 0.0));
}
