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

// Optical depth of a segment at the node's greatest density, in steps. Density varies along thin segments as along thick ones, and thin ones
// do not saturate: they take finer steps. Behind cloud that hides most, errors hide too: steps grow to five times there (docs/decisions/0010).
WK_CONST float kDepthShare = F(0.6);
WK_CONST float kLeastCount = F(0.1);

struct StepPlace {
  float span_m;         // way through the brick
  float nodeHalf_m;     // half the node's size
  float halves;         // of the node's size in it, counted along the axis that the ray follows most
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
  if (rule == kStepOptical) count = min(p.halves, p.bound / kDepthShare) * mix(kLeastCount, F(1.0), p.transmittance);
  return max(ceil(count / step), F(1.0));
}

WK_END
