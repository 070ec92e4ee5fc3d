#pragma once
// One segment of dL/ds = -sigma(s) (L - S(s)), seen from its front: how much of the source S at each node reaches the front, and how much of what
// lies behind passes. Along a ray, L += T * sum(gain * S), then T *= transmittance. Nothing here grows without bound but the explicit
// rules' gains, and these by a known factor (gainExcess): in a medium of constant sigma and S they make gainExcess(x) times the light, x = sigma * length.
#include "welkin/shared/prelude.glsl.h"
WK_BEGIN

WK_CONST uint kRectangle = 0u;            // explicit: quadrature of T(s) sigma(s) S(s), T from the same samples' optical depth
WK_CONST uint kTrapezoid = 1u;
WK_CONST uint kSimpson = 2u;
WK_CONST uint kSimpson38 = 3u;
WK_CONST uint kExponentialConstant = 4u;  // exact for constant sigma and S, whatever the thickness
WK_CONST uint kExponentialLinear = 5u;    // exact for constant sigma and S linear through this midpoint and the one before
WK_CONST uint kAdaptive = 6u;             // two exponential halves; one exponential whole estimates the error
WK_CONST uint kIntegrators = 7u;

// Samples that a segment takes, and where: 0 front, 1 back. Rules whose last node is at 1 share it with the next segment's first.
WK_FN uint integratorNodes(uint rule) {
  return rule == kTrapezoid ? 2u : rule == kSimpson || rule == kAdaptive ? 3u : rule == kSimpson38 ? 4u : 1u;
}
WK_FN float integratorNode(uint rule, uint node) {
  if (rule == kExponentialConstant || rule == kExponentialLinear) return F(0.5);
  return rule == kRectangle ? F(0.0) : float(node) / float(integratorNodes(rule) - 1u);
}

struct SegmentGains {
  float transmittance;
  vec4 gain;    // of each node; of kExponentialLinear the second is that of the midpoint before
  vec4 coarse;  // kAdaptive: the same of one exponential whole, for the error; else equal to gain
};

// 1 - exp(-tau) without cancellation: below 1/4 the series, whose next term is 5e-8 of it there.
WK_FN float opacityOf(float tau) {
  float t = min(tau, F(0.25));
  float series = t * (F(1.0) - t * F(0.5) * (F(1.0) - t * F(0.33333333) * (F(1.0) - t * F(0.25) * (F(1.0) - t * F(0.2) * (F(1.0) - t * F(0.16666667))))));
  return tau < F(0.25) ? series : F(1.0) - exp2(tau * F(-1.44269504));
}
WK_FN float transmittanceOf(float tau) { return exp2(tau * F(-1.44269504)); }

// Where in a segment of even density, 0 front to 1 back, the light that it sends forward comes from on average:
// 1/tau - 1/(e^tau - 1), 1/2 when thin and 1/tau when thick; this quotient is within 0.011 of it everywhere.
WK_FN float emissionDepth(float tau) {
  return (F(0.5) + tau * F(0.0833333333)) / (F(1.0) + tau * (F(0.3333333333) + tau * F(0.0833333333)));
}

// `extinction_per_m` at the rule's nodes, not negative; `length_m` not negative. Optical depths up to a node come from the polynomial through the
// samples (Newton-Cotes, open at that end), and are not negative: between samples that jump the polynomial may be.
WK_FN SegmentGains segmentGains(uint rule, vec4 extinction_per_m, float length_m) {
  vec4 x = extinction_per_m * length_m;
  vec4 gain = vec4(F(0.0), F(0.0), F(0.0), F(0.0));
  if (rule == kRectangle) {
    gain.x = x.x;
    return WK_NEW(SegmentGains, transmittanceOf(x.x), gain, gain);
  }
  if (rule == kTrapezoid) {
    float kept = transmittanceOf(F(0.5) * (x.x + x.y));
    gain = vec4(F(0.5) * x.x, F(0.5) * x.y * kept, F(0.0), F(0.0));
    return WK_NEW(SegmentGains, kept, gain, gain);
  }
  if (rule == kSimpson) {
    float kept = transmittanceOf((x.x + F(4.0) * x.y + x.z) * F(0.16666667));
    float middle = transmittanceOf(max(F(5.0) * x.x + F(8.0) * x.y - x.z, F(0.0)) * F(0.041666667));
    gain = vec4(x.x * F(0.16666667), x.y * F(0.66666667) * middle, x.z * F(0.16666667) * kept, F(0.0));
    return WK_NEW(SegmentGains, kept, gain, gain);
  }
  if (rule == kSimpson38) {
    float first = transmittanceOf(max(F(9.0) * x.x + F(19.0) * x.y - F(5.0) * x.z + x.w, F(0.0)) * F(0.013888889));
    float second = transmittanceOf((x.x + F(4.0) * x.y + x.z) * F(0.11111111));
    float kept = transmittanceOf((x.x + F(3.0) * (x.y + x.z) + x.w) * F(0.125));
    gain = vec4(x.x * F(0.125), x.y * F(0.375) * first, x.z * F(0.375) * second, x.w * F(0.125) * kept);
    return WK_NEW(SegmentGains, kept, gain, gain);
  }
  if (rule == kAdaptive) {
    float whole = (x.x + F(4.0) * x.y + x.z) * F(0.16666667);
    float near = clamp((F(5.0) * x.x + F(8.0) * x.y - x.z) * F(0.041666667), F(0.0), whole), far = whole - near;
    float kept = transmittanceOf(near), nearDepth = emissionDepth(near), farDepth = emissionDepth(far);
    float nearGain = opacityOf(near), farGain = kept * opacityOf(far);
    gain = vec4(nearGain * (F(1.0) - nearDepth), nearGain * nearDepth + farGain * (F(1.0) - farDepth), farGain * farDepth, F(0.0));
    float plain = F(0.5) * (x.x + x.z), plainGain = opacityOf(plain), depth = emissionDepth(plain);
    vec4 coarse = vec4(plainGain * (F(1.0) - depth), F(0.0), plainGain * depth, F(0.0));
    return WK_NEW(SegmentGains, transmittanceOf(whole), gain, coarse);
  }
  float opacity = opacityOf(x.x);
  float before = rule == kExponentialLinear ? opacity * (F(0.5) - min(emissionDepth(x.x), F(0.5))) : F(0.0);
  gain = vec4(opacity - before, before, F(0.0), F(0.0));
  return WK_NEW(SegmentGains, transmittanceOf(x.x), gain, gain);
}

// kAdaptive: how far the segment's light and opacity may be off, per unit of the transmittance in front of it. Where a thick segment's density
// changes, both estimates may agree and be wrong, for neither knows where the light comes from: there the source's change counts.
WK_FN float segmentError(SegmentGains g, vec4 extinction_per_m, vec4 source) {
  vec4 apart = g.gain - g.coarse, e = extinction_per_m;
  float light = apart.x * source.x + apart.y * source.y + apart.z * source.z, opacity = apart.x + apart.y + apart.z;
  float near = abs(source.y - source.x) * abs(e.y - e.x) / max(e.x + e.y, F(1e-30));
  float far = abs(source.z - source.y) * abs(e.z - e.y) / max(e.y + e.z, F(1e-30));
  return max(max(abs(light), abs(opacity)), (F(1.0) - g.transmittance) * max(near, far));
}

// Light that a rule makes of a medium of constant sigma and S, over what it should be, in segments of optical depth x: the sum of its gains over the opacity.
// 1 for the exponential rules. Rectangle 1 + x/2 ..., trapezoid 1 + x^2/12 ..., both Simpsons 1 + O(x^4); all grow as x when x is great.
WK_FN float gainExcess(uint rule, float x) {
  SegmentGains g = segmentGains(rule, vec4(x, x, x, x), F(1.0));
  float sum = g.gain.x + g.gain.y + g.gain.z + g.gain.w;
  return x > F(0.0) ? sum / opacityOf(x) : F(1.0);
}

WK_END
