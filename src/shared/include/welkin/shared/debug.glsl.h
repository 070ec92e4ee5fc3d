#pragma once
// Colours of the debug views (docs/debug-views.md): the same for the pictures and for their legends.
#include "welkin/shared/phase.glsl.h"
#include "welkin/shared/tonemap.glsl.h"
// Macros, because the preprocessor of GLSL picks by them what a pass compiles. In the order of DebugView (debug_view.h).
#define WK_DEBUG_STEPS 1
#define WK_DEBUG_DETAIL 2
#define WK_DEBUG_OCCUPANCY 3
#define WK_DEBUG_HISTORY 4
#define WK_DEBUG_DENSITY 5
#define WK_DEBUG_LIGHT 6
#define WK_DEBUG_AIR 7
#define WK_DEBUG_NAN 8
WK_BEGIN
#ifdef __cplusplus
using glm::cos, glm::sin;
#endif

WK_CONST float kDebugNone = F(-1.0);  // the value of a pixel that has none: its ray met no clouds; every other value is 0 or more
WK_CONST vec3 kDebugNoneColour = vec3(F(0.055), F(0.06), F(0.075));

// Where the scales begin and end. What lies beyond has the colour of the end.
WK_CONST float kDebugSteps = F(256.0);           // samples, from 1; equal ratios are equally far apart
WK_CONST float kDebugThinnest_per_m = F(1e-5);   // an optical depth of 1 in 100 km
WK_CONST float kDebugThickest_per_m = F(1e-1);   // and in 10 m

// How a pixel of the history view came to be.
WK_CONST uint kHistoryTurn = 0u;      // marched, as its turn in the 4 x 4 was
WK_CONST uint kHistoryRejected = 1u;  // marched, because what the last frame held there did not fit
WK_CONST uint kHistoryYoung = 2u;     // of the last frame: marched 1 to 4 frames ago
WK_CONST uint kHistoryMiddle = 3u;    // 5 to 10
WK_CONST uint kHistoryOld = 4u;       // longer
WK_CONST uint kHistoryKinds = 5u;
WK_FN uint historyKind(uint age, bool turn) {
  if (age == 0u) return turn ? kHistoryTurn : kHistoryRejected;
  return age <= 4u ? kHistoryYoung : age <= 10u ? kHistoryMiddle : kHistoryOld;
}

// From OKLab (B. Ottosson, A perceptual color space for image processing, 2020) to sRGB.
WK_FN vec3 oklabColour(float lightness, float a, float b) {
  float l = lightness + F(0.3963377774) * a + F(0.2158037573) * b;
  float m = lightness - F(0.1055613458) * a - F(0.0638541728) * b;
  float s = lightness - F(0.0894841775) * a - F(1.2914855480) * b;
  l = l * l * l, m = m * m * m, s = s * s * s;
  float red = F(4.0767416621) * l - F(3.3077115913) * m + F(0.2309699292) * s;
  float green = F(-1.2684380046) * l + F(2.6097574011) * m - F(0.3413193965) * s;
  float blue = F(-0.0041960863) * l - F(0.7034186147) * m + F(1.7076147010) * s;
  return clamp(vec3(srgbEncode(max(red, F(0.0))), srgbEncode(max(green, F(0.0))), srgbEncode(max(blue, F(0.0)))), vec3(F(0.0)), vec3(F(1.0)));
}

// The scale from 0 to 1: lightness rises evenly, the hue goes from violet over blue and green to yellow, and equal steps look equally
// far apart (within a fifth, as OKLab has it).
WK_FN vec3 scaleColour(float x) {
  float t = clamp(x, F(0.0), F(1.0));
  float a = F(0.063) + t * (F(-0.200) + t * (F(-0.584) + t * F(0.679)));
  float b = F(-0.110) + t * (F(-0.424) + t * (F(1.493) - t * F(0.788)));
  return oklabColour(F(0.27) + F(0.65) * t, a, b);
}

// Levels of the octree: neighbours are 150 degrees of hue apart, and hues come again after twelve. Bright are those of a planet's clouds
// from orbit to the ground.
WK_FN vec3 levelColour(uint level) {
  float hue = float(level * 5u % 12u) * (kPi / F(6.0)) + F(0.4);
  bool bright = level >= 8u && level < 20u;
  float chroma = bright ? F(0.115) : F(0.10);
  return oklabColour(bright ? F(0.76) : F(0.52), chroma * cos(hue), chroma * sin(hue));
}

WK_FN vec3 historyColour(uint kind) {
  if (kind == kHistoryTurn) return vec3(F(0.93), F(0.93), F(0.90));
  if (kind == kHistoryRejected) return vec3(F(0.95), F(0.36), F(0.16));
  return scaleColour(F(0.62) - F(0.2) * float(kind - kHistoryYoung));  // green, teal, blue: paler is younger
}

// Where a value lies on its scale.
WK_FN float debugPlace(uint view, float value) {
  if (view == uint(WK_DEBUG_STEPS)) return log2(max(value, F(1.0))) / log2(kDebugSteps);
  if (view == uint(WK_DEBUG_DENSITY))
    return log2(max(value, kDebugThinnest_per_m) / kDebugThinnest_per_m) / log2(kDebugThickest_per_m / kDebugThinnest_per_m);
  return value;
}

WK_FN vec3 debugColour(uint view, float value) {
  if (value < F(0.0)) return kDebugNoneColour;
  if (view == uint(WK_DEBUG_DETAIL)) return levelColour(uint(value));
  if (view == uint(WK_DEBUG_HISTORY)) return historyColour(uint(value));
  if (view == uint(WK_DEBUG_NAN)) return value > F(0.0) ? kNanPaint : vec3(F(0.5));
  return scaleColour(debugPlace(view, value));
}

WK_END
