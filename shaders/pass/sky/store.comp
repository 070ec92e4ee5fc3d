// Moments as the field's table holds them (air_field.glsl), and the logarithm of the irradiances.
#include "lib/air_field.glsl"
#include "welkin/shared/bindings.glsl.h"
layout(local_size_x = 64) in;
layout(std140, binding = WK_AIR_PARAMS_BINDING) uniform AirUniforms { AirBlock u_air; };
layout(std430, binding = 2) readonly buffer Moments { vec4 moments[]; };
layout(rgba32f, binding = 0) uniform writeonly image2DArray u_field;
layout(rgba32f, binding = 1) uniform writeonly image2D u_irradiance;
uniform ivec3 u_size;

float columnSun(int x) { return sunCosine(u_air.params, float(x) / float(u_size.x - 1)); }

vec3 ratio(int i, int point) {
  int points = u_size.x * u_size.y;
  vec3 mean = moments[point].rgb;
  return mix(moments[i * points + point].rgb / max(mean, vec3(kDark)), vec3(0.0), lessThanEqual(mean, vec3(kDark)));
}

// Of the nearest two columns that have moments with m > 0, straight on in the sun's cosine.
vec3 continued(int i, ivec2 texel) {
  int inward = texel.x * 2 < u_size.x ? 1 : -1, a = texel.x;
  while (1.0 - columnSun(a) * columnSun(a) < kLeastSin2) a += inward;
  if (a == texel.x) return ratio(i, texel.y * u_size.x + a);
  int b = a + inward;
  vec3 ra = ratio(i, texel.y * u_size.x + a), rb = ratio(i, texel.y * u_size.x + b);
  return ra + (ra - rb) * (columnSun(texel.x) - columnSun(a)) / (columnSun(a) - columnSun(b));
}

void main() {
  int point = int(gl_GlobalInvocationID.x), points = u_size.x * u_size.y;
  if (point >= points) return;
  ivec2 texel = ivec2(point % u_size.x, point / u_size.x);
  vec3 mean = max(moments[point].rgb, vec3(kDark));
  imageStore(u_field, ivec3(texel, 0), vec4(log(mean), 0.0));
  int i = 1;
  for (int l = 1; l <= FIELD_ZONAL; ++l)
    for (int m = 0; m <= (l > FIELD_DEGREE ? 0 : l); ++m) {
      imageStore(u_field, ivec3(texel, i), vec4(m > 0 ? continued(i, texel) : ratio(i, point), 0.0));
      ++i;
    }
  for (int side = 0; side < 2; ++side) {
    vec3 light = moments[(kFieldCount + side) * points + point].rgb;
    imageStore(u_irradiance, texel + ivec2(0, side * u_size.y), vec4(log(max(light, vec3(kDark))), 0.0));
  }
}
