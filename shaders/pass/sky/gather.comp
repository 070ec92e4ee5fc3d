// Radiance that points of the field's table see, one invocation for a point and a direction: light scattered once (SINGLE), or light of the
// field scattered once more (DIFFUSE).
#define FIELD_SIGNED 1  // orders keep the energy of the ones before
#include "lib/air_gather.glsl"
#include "welkin/shared/bindings.glsl.h"
layout(local_size_x = 64) in;
layout(std140, binding = WK_AIR_PARAMS_BINDING) uniform AirUniforms { AirBlock u_air; };
layout(binding = WK_SKY_TRANSMITTANCE_UNIT) uniform sampler2D u_sunDepth;
layout(binding = WK_SKY_IRRADIANCE_UNIT) uniform sampler2D u_irradiance;
layout(binding = WK_SKY_FIELD_UNIT) uniform sampler2DArray u_field;
layout(std430, binding = 0) readonly buffer Directions { vec4 directions[]; };
layout(std430, binding = 1) writeonly buffer Radiance { vec4 radiance[]; };
uniform ivec3 u_size;      // sun angles, altitudes, directions
uniform int u_aboutVertical;  // so many of the directions
uniform int u_first;       // first altitude of this dispatch

void main() {
  int id = int(gl_GlobalInvocationID.x) + u_first * u_size.x * u_size.z;
  // Neighbours in the table share a direction's course: points vary fastest.
  int point = id % u_size.x + (id / (u_size.x * u_size.z)) * u_size.x, k = (id / u_size.x) % u_size.z;
  if (point >= u_size.x * u_size.y) return;
  vec2 coord = vec2(point % u_size.x, point / u_size.x) / (vec2(u_size.xy) - 1.0);
  float altitude = coordAltitude(u_air.params, coord.y), muSun = sunCosine(u_air.params, coord.x);
  GatherDirection d = gatherDirection(u_air.params, directions[k], k >= u_aboutVertical, altitude, muSun);
  AirPath path = AirPath(altitude, d.mu, muSun, d.cosine);
  AirExtent extent = airExtent(u_air.params, altitude, d.mu);
  float factors[AIR_LAYERS];
  for (int i = 0; i < AIR_LAYERS; ++i) {
    bool peaked = (AIR_PEAKED >> i & 1) != 0;
    factors[i] = d.layer < 0 ? (peaked ? 0.0 : phaseValue(kPhases[i], u_air.layers[i].g, d.cosine)) : float(i == d.layer);
  }
  AirSum sum = airAlongPath(u_sunDepth, u_field, u_air, path, airTerms(path, factors), extent, PIECES);
  if (extent.ground && d.layer < 0) sum.light += exp(-sum.reduced) * airGround(u_sunDepth, u_irradiance, u_air, path, extent.length_m);
  radiance[k * u_size.x * u_size.y + point] = vec4(sum.light, 0.0);
}
