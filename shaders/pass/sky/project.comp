// Moments of the radiance that gather.comp found, and the irradiance of horizontal planes.
#include "lib/air_gather.glsl"
#include "welkin/shared/bindings.glsl.h"
layout(local_size_x = 64) in;
layout(std140, binding = WK_AIR_PARAMS_BINDING) uniform AirUniforms { AirBlock u_air; };
layout(std430, binding = 0) readonly buffer Directions { vec4 directions[]; };
layout(std430, binding = 1) readonly buffer Radiance { vec4 radiance[]; };
layout(std430, binding = 2) writeonly buffer Moments { vec4 moments[]; };  // [moment][point], then irradiance facing up and down
uniform ivec3 u_size;
uniform int u_aboutVertical;

const float kMostTaken = 0.9;  // of the mean light: what is left keeps the other moments over it bounded

void main() {
  int point = int(gl_GlobalInvocationID.x), points = u_size.x * u_size.y;
  if (point >= points) return;
  vec2 coord = vec2(point % u_size.x, point / u_size.x) / (vec2(u_size.xy) - 1.0);
  float altitude = coordAltitude(u_air.params, coord.y), muSun = sunCosine(u_air.params, coord.x);
  float sin2 = 1.0 - muSun * muSun, scale[5];
  scale[0] = 1.0;
  for (int m = 1; m < 5; ++m) scale[m] = sin2 < kLeastSin2 ? 0.0 : scale[m - 1] / sin2;
  vec3 sums[kFieldCount], up = vec3(0.0), down = vec3(0.0);
  for (int i = 0; i < kFieldCount; ++i) sums[i] = vec3(0.0);
  for (int k = 0; k < u_size.z; ++k) {
    GatherDirection d = gatherDirection(u_air.params, directions[k], k >= u_aboutVertical, altitude, muSun);
    vec3 light = radiance[k * points + point].rgb * d.weight;
    // What went straight on is taken off last. Where the sun stands in a bright rim it can be more than all: no light is less than none.
    if (d.weight < 0.0) light = max(light, -kMostTaken / 0.28209479 * sums[0]);
    float y[kFieldCount] = harmonics(d.cosine);
    float turn[5] = azimuthal(d.mu, muSun, d.cosine);
    int i = 0;
    // What is gathered about the vertical is smooth, and too few directions to tell higher harmonics apart.
    int last = k < u_aboutVertical ? FIELD_DEGREE : FIELD_ZONAL;
    for (int l = 0; l <= last; ++l)
      for (int m = 0; m <= (l > FIELD_DEGREE ? 0 : l); ++m) sums[i] += y[i] * turn[m] * scale[m] * light, ++i;
    up += max(d.mu, 0.0) * light;
    down += max(-d.mu, 0.0) * light;
  }
  for (int i = 0; i < kFieldCount; ++i) moments[i * points + point] = vec4(sums[i], 0.0);
  moments[kFieldCount * points + point] = vec4(up, 0.0);
  moments[(kFieldCount + 1) * points + point] = vec4(down, 0.0);
}
