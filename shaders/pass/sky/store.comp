// Moments as the field's table holds them (air_field.glsl), and the logarithm of the irradiances.
#include "lib/air_field.glsl"
#include "welkin/shared/bindings.glsl.h"
layout(local_size_x = 64) in;
layout(std430, binding = 2) readonly buffer Moments { vec4 moments[]; };
layout(rgba32f, binding = 0) uniform writeonly image2DArray u_field;
layout(rgba32f, binding = 1) uniform writeonly image2D u_irradiance;
uniform ivec3 u_size;

void main() {
  int point = int(gl_GlobalInvocationID.x), points = u_size.x * u_size.y;
  if (point >= points) return;
  ivec2 texel = ivec2(point % u_size.x, point / u_size.x);
  vec3 mean = max(moments[point].rgb, vec3(kDark));
  imageStore(u_field, ivec3(texel, 0), vec4(log(mean), 0.0));
  for (int i = 1; i < kFieldCount; ++i) imageStore(u_field, ivec3(texel, i), vec4(moments[i * points + point].rgb / mean, 0.0));
  for (int side = 0; side < 2; ++side) {
    vec3 light = moments[(kFieldCount + side) * points + point].rgb;
    imageStore(u_irradiance, texel + ivec2(0, side * u_size.y), vec4(log(max(light, vec3(kDark))), 0.0));
  }
}
