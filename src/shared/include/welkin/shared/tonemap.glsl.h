#pragma once
// From linear radiance to display values.
#include "welkin/shared/prelude.glsl.h"
WK_BEGIN

// Radiance is multiplied by this and 2^EV. Chosen so that at EV 0 a thick sunlit cloud (radiance near 0.8/pi for a sun of irradiance 1)
// shows as 0.91 of white and the clear blue sky near half.
WK_CONST float kBaseExposure = F(8.0);

// Rational fit of the ACES reference rendering and output transforms by S. Hill: matrix into the fit's space, curve, matrix back.
WK_FN float acesCurve(float x) {
  return (x * (x + F(0.0245786)) - F(0.000090537)) / (x * (F(0.983729) * x + F(0.4329510)) + F(0.238081));
}
WK_FN vec3 acesFilmic(vec3 c) {
  vec3 v = vec3(F(0.59719) * c.x + F(0.35458) * c.y + F(0.04823) * c.z, F(0.07600) * c.x + F(0.90834) * c.y + F(0.01566) * c.z,
                F(0.02840) * c.x + F(0.13383) * c.y + F(0.83777) * c.z);
  v = vec3(acesCurve(v.x), acesCurve(v.y), acesCurve(v.z));
  v = vec3(F(1.60475) * v.x - F(0.53108) * v.y - F(0.07367) * v.z, F(-0.10208) * v.x + F(1.10813) * v.y - F(0.00605) * v.z,
           F(-0.00327) * v.x - F(0.07276) * v.y + F(1.07602) * v.z);
  return clamp(v, vec3(F(0.0)), vec3(F(1.0)));
}

// IEC 61966-2-1.
WK_FN float srgbEncode(float x) { return x <= F(0.0031308) ? F(12.92) * x : F(1.055) * pow(x, F(1.0) / F(2.4)) - F(0.055); }

// -0.5..0.5, a function of the pixel alone: the same in every frame. (PCG hash, Jarzynski and Olano 2020.)
WK_FN float pixelDither(uint x, uint y) {
  uint state = (x + y * 65536u) * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  word = (word >> 22u) ^ word;
  return float(word >> 8u) * F(5.9604644775390625e-8) - F(0.5);
}

// `exposure` includes kBaseExposure. Display values 0..1, dithered by half a step of 8 bits.
WK_FN vec3 toneMap(vec3 radiance, float exposure, uint x, uint y) {
  vec3 c = acesFilmic(max(radiance, vec3(F(0.0))) * exposure);
  float d = pixelDither(x, y) * (F(1.0) / F(255.0));
  return clamp(vec3(srgbEncode(c.x) + d, srgbEncode(c.y) + d, srgbEncode(c.z) + d), vec3(F(0.0)), vec3(F(1.0)));
}

WK_END
