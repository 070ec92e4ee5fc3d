// Where each pixel's clouds came from in the frame that was just drawn (docs/debug-views.md).
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/debug.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(r32f, binding = 0) uniform writeonly image2D u_value;
layout(rgba8, binding = 1) uniform writeonly image2D u_picture;
layout(binding = WK_CLOUD_AGE_UNIT) uniform usampler2D u_age;
uniform ivec2 u_size;
uniform ivec2 u_turn;  // pixel of each 4 x 4 that was to be marched; negative: all of them were

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, u_size))) return;
  bool turn = u_turn.x < 0 || all(equal(pixel & 3, u_turn));
  uint kind = historyKind(texelFetch(u_age, pixel, 0).x, turn);
  imageStore(u_value, pixel, vec4(float(kind)));
  imageStore(u_picture, pixel, vec4(historyColour(kind), 1.0));
}
