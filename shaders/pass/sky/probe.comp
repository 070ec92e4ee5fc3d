// Radiance and optical depth along single rays, each integrated on its own, in stretches between the places where the path, the medium
// or its light has a kink.
#include "lib/air_path.glsl"
#include "welkin/shared/bindings.glsl.h"
layout(local_size_x = 8) in;
layout(std140, binding = WK_AIR_PARAMS_BINDING) uniform AirUniforms { AirBlock u_air; };
layout(binding = WK_SKY_TRANSMITTANCE_UNIT) uniform sampler2D u_sunDepth;
layout(binding = WK_SKY_IRRADIANCE_UNIT) uniform sampler2D u_irradiance;
layout(binding = WK_SKY_FIELD_UNIT) uniform sampler2DArray u_field;
struct ProbePath {
  vec4 anchor;   // altitude, zenith cosine, the sun's, cosine between path and sun
  vec4 rest;     // x: 1 if the ground is at the end
  float ends[STRETCHES];  // distances where stretches end; the last one is the path's
};
layout(std430, binding = 0) readonly buffer Paths { ProbePath paths[]; };
layout(std430, binding = 1) writeonly buffer Answers { vec4 answers[]; };  // radiance, optical depth
uniform int u_count;

void main() {
  int id = int(gl_GlobalInvocationID.x);
  if (id >= u_count) return;
  ProbePath q = paths[id];
  AirPath path = AirPath(q.anchor.x, q.anchor.y, q.anchor.z, q.anchor.w);
  AirTerms terms = airTerms(path, airPhases(u_air, path.cosine, true));
  AirSum sum = airNothing();
  float start = 0.0, t0 = 0.0;
  for (int i = 0; i < STRETCHES * PIECES; ++i) {
    int stretch = i / PIECES;
    float x = float(i % PIECES + 1) / float(PIECES);
    if (i % PIECES == 0) start = t0;
    float t1 = start + (q.ends[stretch] - start) * x * x * (3.0 - 2.0 * x);  // dense at both ends
    if (t1 > t0) sum = airStretch(u_sunDepth, u_field, u_air, path, terms, sum, t0, t1);
    t0 = t1;
  }
  if (q.rest.x > 0.0) sum.light += exp(-sum.reduced) * airGround(u_sunDepth, u_irradiance, u_air, path, q.ends[STRETCHES - 1]);
  answers[2 * id] = vec4(sum.light, 0.0);
  answers[2 * id + 1] = vec4(sum.depth, 0.0);
}
