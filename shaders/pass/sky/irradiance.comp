// Sky irradiance for every altitude and sun zenith angle: planes facing up, then (second dispatch) facing down.
#include "lib/air_irradiance.glsl"
#include "welkin/shared/bindings.glsl.h"
layout(local_size_x = 8, local_size_y = 4) in;
layout(std140, binding = WK_AIR_PARAMS_BINDING) uniform AirUniforms { AirBlock u_air; };
layout(binding = WK_SKY_TRANSMITTANCE_UNIT) uniform sampler2D u_transmittance;
layout(binding = WK_SKY_VIEW_TRANSMITTANCE_UNIT) uniform sampler2D u_multiple;
layout(binding = WK_SKY_IRRADIANCE_UNIT) uniform sampler2D u_irradiance;
layout(rgba32f, binding = 0) uniform writeonly image2D u_out;
uniform float u_facing;  // 1 up, -1 down

void main() {
  vec2 coord = vec2(gl_GlobalInvocationID.xy) / (vec2(kSunTexels, kAltitudeTexels) - 1.0);
  float altitude = coordAltitude(u_air.params, coord.y);
  vec3 light = airIrradianceAt(u_transmittance, u_multiple, u_irradiance, u_air, altitude, sunCosine(coord.x), u_facing);
  uvec2 texel = gl_GlobalInvocationID.xy + uvec2(0u, u_facing < 0.0 ? kAltitudeTexels : 0u);
  imageStore(u_out, ivec2(texel), vec4(light, 0.0));
}
