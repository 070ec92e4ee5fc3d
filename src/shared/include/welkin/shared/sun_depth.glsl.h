#pragma once
// How bricks store the optical depth towards the sun.
#include "welkin/shared/prelude.glsl.h"
WK_BEGIN

// The sun's optical depth is stored as g = tau / (tau + 5): steps of 1e-4 for thin air, of 0.03 at depth 100.
WK_CONST float kDepthScale = F(5.0);
WK_FN float encodeDepth(float tau) { return tau / (tau + kDepthScale); }
WK_FN float decodeDepth(float g) { return kDepthScale * g / max(F(1.0) - g, F(1.0e-4)); }

WK_END
