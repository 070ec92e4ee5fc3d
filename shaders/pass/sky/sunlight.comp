// The sun's light at every altitude, mean over the visible part of its disc: logarithm of its optical depth, placed by the disc's upper edge.
#include "lib/air.glsl"
#include "welkin/shared/bindings.glsl.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = WK_AIR_PARAMS_BINDING) uniform AirUniforms { AirBlock u_air; };
layout(binding = WK_SKY_TRANSMITTANCE_UNIT) uniform sampler2D u_pointDepth;
layout(rgba32f, binding = 0) uniform writeonly image2D u_out;

void main() {
  AirParams p = u_air.params;
  vec2 size = vec2(kTransmittanceWidth, kTransmittanceHeight);
  vec2 point = transmittancePoint(p, vec2(gl_GlobalInvocationID.xy) / (size - 1.0));
  float h = point.x, edge = point.y;
  float horizon = horizonCosine(p.radius_m, h);
  float sine = sqrt(max(1.0 - edge * edge, 0.0));
  // Angle between the upper edge and the horizon in units of the sun's radius, at most the whole disc.
  float above_rad = (edge - horizon) * (p.radius_m + h) / p.radius_m;
  float depth_ = clamp(above_rad / p.sunRadius_rad, 0.0, 2.0);
  // Over the chords of the disc by angle a: chord height 1 - cos a below the edge, area proportional to sin^2 a.
  float last = acos(1.0 - depth_);
  const int kChords = 8;
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (int i = 0; i < kChords; ++i) {
    float a = last * (float(i) + 0.5) / float(kChords);
    float below = p.sunRadius_rad * (1.0 - cos(a));
    float mu = max(edge * cos(below) - sine * sin(below), horizon);
    vec2 uv = airTexel(transmittanceCoord(p, h, mu), size);
    float w = sin(a) * sin(a);
    sum += w * exp(-exp(textureLod(u_pointDepth, uv, 0.0).rgb));
    weights += w;
  }
  // The edge itself where nothing of the disc is above the horizon. -log of a mean of 0 is the depth whose light is the smallest float.
  vec3 mean = weights > 0.0 ? sum / weights : exp(-exp(textureLod(u_pointDepth, airTexel(transmittanceCoord(p, h, max(edge, horizon)), size), 0.0).rgb));
  vec3 depth = -log(max(mean, vec3(1.17549435e-38)));
  imageStore(u_out, ivec2(gl_GlobalInvocationID.xy), vec4(log(max(depth, vec3(kNoDepth))), 0.0));
}
