#pragma once
// How sun and sky light a point inside a cloud, from four numbers: its optical depth towards the sun; those of the whole straight lines
// through it, along the sun's direction and upright (the cloud's chords); and the sun's height (docs/decisions/0019). Held against a path
// tracer in docs/reference.md. All are per unit of irradiance, in 1/sr: multiplied by extinction and path length they give radiance
// (droplets do not absorb visible light: albedo 1).
#include "welkin/shared/phase.glsl.h"
#include "welkin/shared/sun_depth.glsl.h"
WK_BEGIN

// Droplets: a strong forward lobe (silver lining) and a weak backward one. Asymmetry 0.87 * 0.85 - 0.13 * 0.3 = 0.70 after the
// forward peak within a few degrees is counted as not scattered.
WK_CONST float kForwardG = F(0.85);
WK_CONST float kBackwardG = F(-0.3);
WK_CONST float kForwardShare = F(0.87);
WK_CONST float kAsymmetry = F(0.7005);
WK_CONST float kSimilar = F(0.2995);  // 1 - asymmetry: light that spreads takes an optical depth for that times it (van de Hulst 1980)
WK_CONST float kBroadened = F(0.7);   // asymmetry of light after some forward scatterings, as a share; the one number that is fitted
WK_FN float cloudPhase(float cosTheta, float sharpness) {
  return mix(phaseHenyeyGreenstein(cosTheta, kBackwardG * sharpness), phaseHenyeyGreenstein(cosTheta, kForwardG * sharpness), kForwardShare);
}

// Of light scattered once, and some times forwards. Constant along a ray.
struct CloudPhases {
  float single;
  float broad;
};
WK_FN CloudPhases cloudPhases(float cosTheta) { return WK_NEW(CloudPhases, cloudPhase(cosTheta, F(1.0)), cloudPhase(cosTheta, kBroadened)); }

// A point's surroundings, taken as a slab. Its normal lies between the sun's direction (as thick upright as along the sun's line, or thicker:
// a ball, a tower lit from its side) and up (thicker along the sun's line by the sun's slant: a deck).
struct CloudSlab {
  float slant;   // cosine between normal and sun
  float depth;   // across it, times kSimilar
  float normal;  // cosine between normal and the view ray's direction
};
WK_CONST float kLeastSlant = F(0.05);  // a sun 3 degrees high: under a lower one it is a deck's own slopes that are lit
// Chords are kept at the corners of bricks, and a cloud of a few voxels may lie between: at a point of it its chord is that of about so many
// voxels of its density. Measured (docs/decisions/0019): least error against chords of every point's own.
WK_CONST float kOwnVoxels = F(1.5);
WK_FN float ownChord(float extinction_per_m, float voxel_m) { return kOwnVoxels * extinction_per_m * voxel_m; }
// Depths of both chords; cosines of the sun's and the ray's zenith angles, and between both.
WK_FN CloudSlab cloudSlab(float sunChord, float upChord, float muSun, float muView, float cosTheta) {
  float deck = clamp(muSun, kLeastSlant, F(1.0));
  float slant = clamp(upChord / max(sunChord, F(1.0e-12)), deck, F(1.0));
  float ball = (slant - deck) / max(F(1.0) - deck, F(1.0e-12));
  return WK_NEW(CloudSlab, slant, kSimilar * slant * sunChord, mix(muView, cosTheta, ball));
}

// Of diffuse light from above what arrives at this sun depth; of that from below it is what is left to 1. Eddington's approximation of a slab
// that absorbs nothing: linear in depth, half at both faces of a thin one, from 1 to 0 in a thick one.
WK_FN float openShare(float tau, CloudSlab slab) {
  float below = max(slab.depth - kSimilar * slab.slant * tau, F(0.0));
  return (F(0.5) + F(0.75) * below) / (F(1.0) + F(0.75) * slab.depth);
}

// In-scatter of sunlight: scattered once; the beam that was scattered forwards only; and what spreads, by Eddington's approximation of a slab lit
// by the beam exp(-kSimilar tau): mean radiance J, and flux across the slab, of which light that goes along it has more.
//   d flux / d t = beam,  dJ / dt = -3 flux / (4 pi),  no diffuse light enters a face: pi J = |flux| / 2 there
WK_FN float sunSource(CloudPhases phases, float tau, CloudSlab slab) {
  float direct = exp2(tau * F(-1.44269504));
  float beam = exp2(tau * (F(-1.44269504) * kSimilar));
  float through = exp2(slab.depth / slab.slant * F(-1.44269504));
  float open = openShare(tau, slab), steep = F(0.75) * slab.slant;
  float mean = (F(0.5) + steep) * open - steep * beam - (F(0.5) - steep) * through * (F(1.0) - open);
  float net = (F(0.5) + steep + (F(0.5) - steep) * through) / (F(1.0) + F(0.75) * slab.depth) - beam;
  float diffuse = max(mean + F(0.75) * kAsymmetry * net * slab.normal, F(0.0)) * slab.slant / kPi;
  return phases.single * direct + phases.broad * (beam - direct) + diffuse;
}

// Diffuse light from above and from below. A ray sums opacity, and opacity times openShare; both sources follow.
WK_FN float skySource(float openOpacity) { return openOpacity / kPi; }
WK_FN float groundSource(float opacity, float openOpacity) { return (opacity - openOpacity) / kPi; }

// Share of the sun's irradiance that reaches the ground through cloud of this optical depth: the direct beam, and half of what a
// conservative two-stream cloud lets through (1 / (1 + 0.1 tau)); the other half falls outside the shadow.
WK_FN float cloudShadow(float tau) {
  float direct = exp2(tau * F(-1.44269504));
  return direct + (F(1.0) - direct) * F(0.5) / (F(1.0) + F(0.1) * tau);
}

WK_END
