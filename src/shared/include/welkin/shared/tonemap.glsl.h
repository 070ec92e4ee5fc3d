#pragma once
// From linear radiance to display values.
#include "welkin/shared/prelude.glsl.h"
WK_BEGIN

// Radiance is multiplied by this and 2^EV before it meets the curve. Chosen so that at EV 0 a thick sunlit cloud (radiance near 0.8/pi for a sun of irradiance 1)
// shows as 0.91 of white and the clear blue sky near half.
WK_CONST float kBaseExposure = F(8.0);

// Where a pass found a NaN or Inf: magenta, without a trace of green, which no light of a scene has.
WK_CONST vec3 kNanPaint = vec3(F(1.0), F(0.0), F(1.0));

// What a tone curve gets: exposed radiance, none of it negative. From kToneGreatest on every curve shows white; held there, its powers
// stay finite.
WK_CONST float kToneGreatest = F(1e6);
WK_FN vec3 toneInput(vec3 radiance, float exposure) { return min(max(radiance, vec3(F(0.0))) * exposure, vec3(kToneGreatest)); }

// Relative luminance of linear sRGB (IEC 61966-2-1, which takes the primaries of ITU-R BT.709).
WK_FN float luminance(vec3 c) { return F(0.2126) * c.x + F(0.7152) * c.y + F(0.0722) * c.z; }

// The tone curves: exposed linear colour in, linear display colour 0..1 out. A shader names the one it runs in TONE_CURVE.

// aces: rational fit of the ACES reference rendering and output transforms by S. Hill: matrix into the fit's space, curve, matrix back.
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

// reinhard: Reinhard, Stark, Shirley and Ferwerda 2002, equation 4, of the luminance; the colour's ratios stay. kReinhardWhite is the
// smallest luminance shown as white: one stop over a thick sunlit cloud at EV 0.
WK_CONST float kReinhardWhite = F(4.0);
WK_FN vec3 reinhardExtended(vec3 c) {
  float y = luminance(c);
  return min(c * ((F(1.0) + y * (F(1.0) / (kReinhardWhite * kReinhardWhite))) / (F(1.0) + y)), vec3(F(1.0)));
}

// lottes: T. Lottes, Advanced Techniques and Optimization of HDR Color Pipelines, GDC 2016, each colour by itself: x^a / (x^(a d) b + c)
// with contrast a = 1.6 and shoulder d = 0.977; b and c are solved so that 0.18 is shown as 0.267 and 8 as 1. It would go on rising
// beyond 8.
WK_CONST float kLottesContrast = F(1.6);
WK_CONST float kLottesShoulder = F(0.977);
WK_CONST float kLottesWhite = F(8.0);
WK_CONST float kLottesB = F(1.0730397117);
WK_CONST float kLottesC = F(0.16741993818);
WK_FN float lottesCurve(float x) {
  float v = min(x, kLottesWhite);
  return min(pow(v, kLottesContrast) / (pow(v, kLottesContrast * kLottesShoulder) * kLottesB + kLottesC), F(1.0));
}
WK_FN vec3 lottes(vec3 c) { return vec3(lottesCurve(c.x), lottesCurve(c.y), lottesCurve(c.z)); }

// uchimura: H. Uchimura, HDR Theory and Practice, CEDEC 2017, each colour by itself: a toe, a straight part and a shoulder. Published
// parameters: greatest brightness 1, contrast 1, straight from m = 0.22 over l = 0.4 of what is left, toe m (x / m)^1.33.
WK_CONST float kUchimuraStart = F(0.22);
WK_CONST float kUchimuraLength = F(0.4);
WK_CONST float kUchimuraToe = F(1.33);
WK_FN float uchimuraCurve(float x) {
  const float shoulder = kUchimuraStart + (F(1.0) - kUchimuraStart) * kUchimuraLength;  // with contrast 1 its value too
  float t = clamp(x / kUchimuraStart, F(0.0), F(1.0));
  float straight = t * t * (F(3.0) - F(2.0) * t);  // how much of the straight part is in the toe
  float toe = kUchimuraStart * pow(t, kUchimuraToe);
  float low = mix(toe, min(x, shoulder), straight);
  float high = F(1.0) - (F(1.0) - shoulder) * exp((shoulder - x) / (F(1.0) - shoulder));
  return x < shoulder ? low : high;
}
WK_FN vec3 uchimura(vec3 c) { return vec3(uchimuraCurve(c.x), uchimuraCurve(c.y), uchimuraCurve(c.z)); }

// IEC 61966-2-1.
WK_FN float srgbEncode(float x) { return x <= F(0.0031308) ? F(12.92) * x : F(1.055) * pow(x, F(1.0) / F(2.4)) - F(0.055); }

// -0.5..0.5, a function of the pixel alone: the same in every frame. (PCG hash, Jarzynski and Olano 2020.)
WK_FN float pixelDither(uint x, uint y) {
  uint state = (x + y * 65536u) * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  word = (word >> 22u) ^ word;
  return float(word >> 8u) * F(5.9604644775390625e-8) - F(0.5);
}

// From a curve's colour to display values 0..1 (sRGB), dithered by half a step of 8 bits.
WK_FN vec3 displayValues(vec3 c, uint x, uint y) {
  float d = pixelDither(x, y) * (F(1.0) / F(255.0));
  return clamp(vec3(srgbEncode(c.x) + d, srgbEncode(c.y) + d, srgbEncode(c.z) + d), vec3(F(0.0)), vec3(F(1.0)));
}

WK_END
