#pragma once
// How sun and sky light a point inside a cloud, from the sun's optical depth alone. Named, so that a path tracer can be held
// against each. All are per unit of sun irradiance or of sky irradiance, in 1/sr: multiplied by extinction and path length they give
// radiance (droplets do not absorb visible light: albedo 1).
#include "welkin/shared/phase.glsl.h"
#include "welkin/shared/sun_depth.glsl.h"
WK_BEGIN

// Droplets: a strong forward lobe (silver lining) and a weak backward one. Asymmetry 0.87 * 0.85 - 0.13 * 0.3 = 0.70 after the
// forward peak within a few degrees is counted as not scattered.
WK_CONST float kForwardG = F(0.85);
WK_CONST float kBackwardG = F(-0.3);
WK_CONST float kForwardShare = F(0.87);
WK_FN float cloudPhase(float cosTheta, float sharpness) {
  return mix(phaseHenyeyGreenstein(cosTheta, kBackwardG * sharpness), phaseHenyeyGreenstein(cosTheta, kForwardG * sharpness), kForwardShare);
}

// Phase values of three scattering octaves (Wrenninge et al. 2013, "Oz: the great and volumetric"): each is broader and
// reaches deeper than the one before. Constant along a ray.
struct CloudPhases {
  float single;
  float second;
  float third;
};
WK_FN CloudPhases cloudPhases(float cosTheta) {
  return WK_NEW(CloudPhases, cloudPhase(cosTheta, F(1.0)), cloudPhase(cosTheta, F(0.6)), cloudPhase(cosTheta, F(0.35)));
}

// Share of diffuse light that arrives at a sun depth: diffusion decays as 1 / (1 + 0.75 (1 - g) tau), not exponentially (two-stream
// solution), so a thick cloud is grey underneath, not black. With g = 0.73 that is 1 / (1 + tau / 5), one minus the stored form.
WK_FN float skyShare(float encoded) { return F(1.0) - encoded; }

// In-scatter of sunlight at a point whose sun depth is stored as `encoded`. The diffuse part builds up over the first optical depths.
WK_CONST float kDiffuseGain = F(2.2);
WK_FN float sunSource(CloudPhases phases, float encoded) {
  float quarter = exp2(decodeDepth(encoded) * F(-0.36067376));  // exp(-tau / 4)
  float half_ = quarter * quarter;
  float diffuse = kDiffuseGain / (F(4.0) * kPi) * (F(1.0) - F(0.8) * half_) * skyShare(encoded);
  return phases.single * half_ * half_ + phases.second * half_ + phases.third * quarter + diffuse;
}

// Light of the sky arrives as diffuse light does. Light from the ground reaches what the sky does not: from a quarter at the top to all of
// it far down. A ray sums opacity, and opacity times share; both sources follow.
WK_FN float skySource(float openOpacity) { return openOpacity * (F(0.5) / kPi); }
WK_FN float groundSource(float opacity, float openOpacity) { return (opacity - F(0.75) * openOpacity) * (F(0.5) / kPi); }

// Share of the sun's irradiance that reaches the ground through cloud of this optical depth: the direct beam, and half of what a
// conservative two-stream cloud lets through (1 / (1 + 0.1 tau)); the other half falls outside the shadow.
WK_FN float cloudShadow(float tau) {
  float direct = exp2(tau * F(-1.44269504));
  return direct + (F(1.0) - direct) * F(0.5) / (F(1.0) + F(0.1) * tau);
}

WK_END
