#pragma once
// What a ray through the clouds brings, whoever integrated it: the march, or the reference for pictures of the truth.
#include "welkin/shared/prelude.glsl.h"
WK_BEGIN

// A pixel's clouds (std430, 20 bytes).
struct CloudWeights {
  float sun;            // in-scatter weights, 1/sr: times sun irradiance, times sky and ground irradiance
  float sky;
  float ground;
  float transmittance;
  float distance_m;     // from the camera, weighted by what each point adds to opacity; of the ground or the sky if nothing is met
};

WK_CONST float kSkyDistance_m = F(1e12);  // what is not there moves with the camera: only rotation reprojects it

WK_END
