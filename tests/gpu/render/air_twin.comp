// Test: the shared functions on the GPU, one row of answers for each row of inputs.
#include "lib/air.glsl"
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/ground.glsl.h"
#include "welkin/shared/tonemap.glsl.h"
layout(local_size_x = 64) in;
layout(std140, binding = WK_AIR_PARAMS_BINDING) uniform AirUniforms { AirBlock u_air; };
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };  // altitude, cosine, 0..1, 0..1
layout(std430, binding = 1) buffer Answers { float answers[]; };
layout(binding = WK_SKY_IRRADIANCE_UNIT) uniform sampler2D u_irradiance;

void main() {
  uint i = gl_GlobalInvocationID.x;
  vec4 x = inputs[i];
  AirParams p = u_air.params;
  uint o = 16u * i;
  for (uint k = 0u; k < 3u; ++k) answers[o + k] = layerDensity(u_air.layers[k], x.x);
  answers[o + 3u] = phaseCornetteShanks(x.y, 0.8);
  answers[o + 4u] = airOpticalDepthToTop(u_air, x.x, abs(x.y), 8u).y;
  answers[o + 5u] = sunVisible(p, x.x, x.y * 0.3);
  answers[o + 6u] = transmittanceCoord(p, x.x, abs(x.y)).x;
  answers[o + 7u] = viewCoord(u_air.view, x.y, x.y < u_air.view.muHorizon);
  answers[o + 8u] = airSliceOf(2.0 * x.z - 1.0, x.w);
  answers[o + 9u] = sunCoord(p, x.y);
  answers[o + 10u] = acesFilmic(vec3(4.0 * x.z, x.w, x.w * x.z)).x;
  answers[o + 11u] = srgbEncode(x.z);
  answers[o + 12u] = pixelDither(uint(x.x), uint(1000.0 * x.z));
  vec3 sun = normalize(vec3(x.y, 0.3, x.z + 0.05));
  answers[o + 13u] = groundRadiance(vec3(0.02, 0.03, 0.08), vec3(0.0, 0.0, 1.0), sun, normalize(vec3(0.2, x.y, x.w + 0.05)), vec3(1.0), vec3(0.2)).y;
  AirLight light = airSkyIrradiance(u_irradiance, p, x.x, x.y);
  answers[o + 14u] = light.fromAbove.y;
  answers[o + 15u] = light.fromBelow.y;
}
