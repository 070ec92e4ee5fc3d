#pragma once
// How many segments the march makes of its way through a brick. All rules share one number, `step`: halving it halves every segment.
#include "welkin/shared/prelude.glsl.h"
WK_BEGIN

WK_CONST uint kStepUniform = 0u;    // the way through the clouds' shell in 64 / step equal parts
WK_CONST uint kStepGeometric = 1u;  // the first as by node, each longer than the last: by step / 16 of the way since the shell's entry
WK_CONST uint kStepOptical = 2u;    // by node, or fewer where the node's greatest density makes little optical depth; fewer behind cloud
WK_CONST uint kStepPixel = 3u;      // by the size of the node that a pixel can show at this distance, whatever is resident
WK_CONST uint kStepNode = 4u;       // step times half the node's size
WK_CONST uint kStepRules = 5u;

// The optical rule's constants, found by measurement (docs/decisions/0014). What a thin brick may err falls with its depth, and by a power of its
// segments: the same number of samples errs least in all if a brick of depth x gets a power of x under 1, here its cube root. Behind cloud that
// hides most, errors hide too.
WK_CONST float kThinCount = F(1.5);
WK_CONST float kLeastCount = F(0.05);
// Clouds lie in layers: along rays that go up or down density changes faster than along level ones.
WK_CONST float kLevelCount = F(.268);
WK_CONST float kUprightCount = F(1.95);
// Where nodes are coarser than pixels show (the budget ends, or the depth), a segment's error covers many pixels and is seen: finer there.
WK_CONST float kCoarseShare = F(.12);
WK_CONST float kCoarseMost = F(1.65);

struct StepPlace {
  float span_m;         // way through the brick
  float nodeHalf_m;     // half the node's size
  float halves;         // of the node's size in it, counted along the axis that the ray follows most
  float parentWeight;   // of its parent, which fades in
  float upright;        // |cosine| of the ray's zenith angle
  float bound;          // optical depth of it at the node's greatest density
  float transmittance;  // of what is in front
  float since_m;        // from the entry into the clouds' shell
  float shell_m;        // length of the whole way through the shell
  float entryHalf_m;    // half the size of the node sampled at the entry
  float pixelHalf_m;    // half the size of the node that a pixel can show here
};

WK_FN float segmentCount(uint rule, float step, StepPlace p) {
  float count = p.span_m / p.nodeHalf_m;
  if (rule == kStepUniform) count = F(64.0) * p.span_m / p.shell_m;
  if (rule == kStepGeometric) count = p.span_m / (p.entryHalf_m + F(0.0625) * p.since_m);
  if (rule == kStepPixel) count = p.span_m / p.pixelHalf_m;
  if (rule == kStepOptical) {
    // where a level fades out into its parent, segments grow to the parent's, twice as long
    float halves = p.halves * mix(kLevelCount, kUprightCount, p.upright) * (F(1.0) - F(0.5) * p.parentWeight);
    float coarse = clamp(kCoarseShare * p.nodeHalf_m / p.pixelHalf_m, F(1.0), kCoarseMost);
    count = min(halves, kThinCount * pow(p.bound, F(0.33333333))) * coarse * mix(kLeastCount, F(1.0), p.transmittance);
  }
  return max(ceil(count / step), F(1.0));
}

WK_END
