#pragma once
// Phase functions, 1/sr: each integrates to 1 over the sphere of directions. `c` is the cosine of the scattering angle.
#include "welkin/shared/prelude.glsl.h"
WK_BEGIN

WK_CONST uint kPhaseRayleigh = 0u;
WK_CONST uint kPhaseCornetteShanks = 1u;
WK_CONST uint kPhaseHenyeyGreenstein = 2u;
WK_CONST uint kPhaseIsotropic = 3u;

WK_CONST float kPi = F(3.14159265358979);
WK_CONST float kInv4Pi = F(0.0795774715459477);

// 3/(16 pi) (1 + c^2)
WK_FN float phaseRayleigh(float c) { return F(0.0596831036594608) * (F(1.0) + c * c); }

// 1 + g^2 - 2 g c, written so that it does not cancel where it is small (g and c near 1).
WK_FN float phaseDenominator(float c, float g) { return (F(1.0) - g) * (F(1.0) - g) + F(2.0) * g * (F(1.0) - c); }

// Henyey and Greenstein 1941; mean cosine g in (-1, 1).
WK_FN float phaseHenyeyGreenstein(float c, float g) {
  float a = phaseDenominator(c, g);
  return kInv4Pi * (F(1.0) - g * g) / (a * sqrt(a));
}

// Cornette and Shanks 1992: Henyey-Greenstein with Rayleigh's symmetry, g = 0 is Rayleigh.
WK_FN float phaseCornetteShanks(float c, float g) {
  float a = phaseDenominator(c, g);
  return F(0.119366207318922) * (F(1.0) - g * g) * (F(1.0) + c * c) / ((F(2.0) + g * g) * a * sqrt(a));  // 3/(8 pi)
}

WK_FN float phaseValue(uint type, float g, float c) {
  if (type == kPhaseRayleigh) return phaseRayleigh(c);
  if (type == kPhaseCornetteShanks) return phaseCornetteShanks(c, g);
  if (type == kPhaseHenyeyGreenstein) return phaseHenyeyGreenstein(c, g);
  return kInv4Pi;
}

WK_END
