// From the histogram to the exposure that is shown; empties the histogram.
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/exposure.glsl.h"
layout(local_size_x = 256) in;
layout(std430, binding = WK_EXPOSURE_BINDING) buffer ExposureBuffer { ExposureBlock exposure; };
uniform vec2 u_percentiles;  // as fractions
uniform vec2 u_limits_ev;
uniform float u_offset_ev;   // EV at which a mean of 0 stops shows as middle grey, compensation included
uniform vec2 u_towards;      // exposureAdapted()

shared uint s_bins[kExposureBins];

void main() {
  uint self = gl_LocalInvocationIndex;
  s_bins[self] = exposure.bins[self];
  exposure.bins[self] = 0u;
  barrier();
  if (self != 0u) return;
  // One thread in a fixed order: a sum of floats that is the same in every run.
  uint pixels = 0u;
  for (uint i = 0u; i < kExposureBins; ++i) pixels += s_bins[i];
  exposure.metered = pixels;
  if (pixels > 0u) {
    uvec2 ranks = exposureRanks(pixels, u_percentiles.x, u_percentiles.y);
    uint before = 0u;
    float sum = 0.0;
    for (uint i = 0u; i < kExposureBins; ++i) {
      sum += float(exposureWeight(before, s_bins[i], ranks)) * exposureBinStops(i);
      before += s_bins[i];
    }
    exposure.target_ev = clamp(u_offset_ev - sum / float(ranks.y - ranks.x), u_limits_ev.x, u_limits_ev.y);
    exposure.adapted_ev = exposure.started == 0u ? exposure.target_ev : exposureAdapted(exposure.adapted_ev, exposure.target_ev, u_towards);
    exposure.started = 1u;
  }
  int steps = exposureSteps(exposure.adapted_ev);
  exposure.ev = float(steps) / float(kEvSteps);
  exposure.scale = exposure.stepScale[uint(steps) % kEvSteps] * powerOfTwo(steps >> 8);
}
