// Test: a tone curve and the display values.
#include "welkin/shared/tonemap.glsl.h"
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 colours[]; };
layout(std430, binding = 1) writeonly buffer Answers { vec4 answers[]; };

void main() {
  uint row = gl_GlobalInvocationID.x;
  vec3 c = TONE_CURVE(toneInput(colours[row].rgb, colours[row].a));
  answers[2u * row] = vec4(c, pixelDither(row, row * 7u));
  answers[2u * row + 1u] = vec4(displayValues(c, row, row * 7u), luminance(c));
}
