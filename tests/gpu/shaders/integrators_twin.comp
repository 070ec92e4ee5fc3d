// Test: gains of a segment by every rule.
#include "welkin/shared/integrators.glsl.h"
layout(local_size_x = 64) in;
struct Row { vec4 extinction_per_m; vec4 other; };  // x: length; y: an optical depth
layout(std430, binding = 0) readonly buffer Inputs { Row rows[]; };
layout(std430, binding = 1) writeonly buffer Answers { float answers[]; };

void main() {
  uint row = gl_GlobalInvocationID.x, at = 74u * row;
  float tau = rows[row].other.y;
  for (uint rule = 0u; rule < kIntegrators; ++rule) {
    SegmentGains g = segmentGains(rule, rows[row].extinction_per_m, rows[row].other.x);
    answers[at++] = g.transmittance;
    for (int i = 0; i < 4; ++i) answers[at++] = g.gain[i];
    for (int i = 0; i < 4; ++i) answers[at++] = g.coarse[i];
    answers[at++] = gainExcess(rule, tau);
  }
  answers[at++] = opacityOf(tau);
  answers[at++] = transmittanceOf(tau);
  answers[at++] = emissionDepth(tau);
  answers[at] = 0.0;
}
