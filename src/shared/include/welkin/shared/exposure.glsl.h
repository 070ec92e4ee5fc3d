#pragma once
// Metering: a histogram of the picture's luminance in stops, the exposure that it asks for, and how fast an eye follows.
// Bins come from the bits of the float and counts are integers, so that a histogram is the same on every device.
#include "welkin/shared/tonemap.glsl.h"
WK_BEGIN

// Luminance counts in units of the scene's own light (a power of two near the sun's irradiance). The first bin begins at 2^-28 of it,
// below a moonless twilight; the last one ends at 2^4, so the sun's disc (2^14) counts as the brightest bin.
WK_CONST uint kExposureBins = 256u;
WK_CONST uint kBinsPerStop = 8u;
WK_CONST int kLowestStop = -28;
// EV is shown in steps of 1/256 stop, a third of an 8-bit step at middle grey; a number with so few digits comes back equal from a file.
WK_CONST uint kEvSteps = 256u;

struct ExposureBlock {
  float ev;          // shown: a multiple of 1 / kEvSteps
  float scale;       // kBaseExposure 2^ev
  float adapted_ev;  // the same before rounding; follows the target
  float target_ev;   // what the last picture asked for
  uint metered;      // pixels that counted in the last picture
  uint started;      // 0: no picture has been metered yet
  uint spare0;
  uint spare1;
  uint bins[256];
  float stepScale[256];  // kBaseExposure 2^(i / kEvSteps), rounded from double: exp2 of a GPU is not the CPU's
};

// The bin of a luminance over 0: eight to a stop, of equal width in light, from the exponent and the first three bits of the fraction.
WK_FN uint exposureBin(float y) {
  int first = (kLowestStop + 127) * int(kBinsPerStop);
  return uint(clamp(int(floatBitsToUint(y) >> 20u) - first, 0, int(kExposureBins) - 1));
}

// Its middle, in stops.
WK_FN float exposureBinStops(uint bin) {
  float part = (float(bin % kBinsPerStop) + F(0.5)) / float(kBinsPerStop);
  return float(kLowestStop + int(bin / kBinsPerStop)) + log2(F(1.0) + part);
}

// Pixels between two percentiles (as fractions): from rank x to rank y, at least one of them.
WK_FN uvec2 exposureRanks(uint pixels, float low, float high) {
  uint first = min(uint(float(pixels) * low), max(pixels, 1u) - 1u);
  return uvec2(first, clamp(uint(ceil(float(pixels) * high)), first + 1u, max(pixels, 1u)));
}

// How many of a bin's pixels lie between these ranks, when `before` pixels are darker than the bin.
WK_FN uint exposureWeight(uint before, uint count, uvec2 ranks) {
  return clamp(before + count, ranks.x, ranks.y) - clamp(before, ranks.x, ranks.y);
}

// One step of exponential adaptation. `towards`: 1 - exp(-dt / time constant), x to a darker exposure (a brighter picture), y to a
// brighter one.
WK_FN float exposureAdapted(float ev, float target, vec2 towards) { return ev + (target - ev) * (target < ev ? towards.x : towards.y); }

// In steps of 1 / kEvSteps.
WK_FN int exposureSteps(float ev) { return int(floor(ev * float(kEvSteps) + F(0.5))); }

// 2^n for n from -126 to 127.
WK_FN float powerOfTwo(int n) { return uintBitsToFloat(uint(n + 127) << 23u); }

WK_END
