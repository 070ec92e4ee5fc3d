// Multiple scattering for every altitude and sun zenith angle.
#include "lib/air_multiple.glsl"
#include "welkin/shared/bindings.glsl.h"
layout(local_size_x = 8, local_size_y = 4) in;
layout(std140, binding = WK_AIR_PARAMS_BINDING) uniform AirUniforms { AirBlock u_air; };
layout(binding = WK_SKY_TRANSMITTANCE_UNIT) uniform sampler2D u_transmittance;
layout(rgba32f, binding = 0) uniform writeonly image2D u_out;

void main() {
  vec2 coord = vec2(gl_GlobalInvocationID.xy) / (vec2(kSunTexels, kAltitudeTexels) - 1.0);
  vec3 source = airMultipleAt(u_transmittance, u_air, coordAltitude(u_air.params, coord.y), sunCosine(coord.x));
  imageStore(u_out, ivec2(gl_GlobalInvocationID.xy), vec4(source, 0.0));
}
