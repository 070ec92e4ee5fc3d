#pragma once
// What the passes of a frame count with atomics (storage buffer WK_COUNTERS_BINDING).
#include "welkin/shared/prelude.glsl.h"
WK_BEGIN

struct Counters {
  uint nanPixels;       // pixels with a NaN or Inf, shown in magenta
  uint holes;           // rays that met a place without data where data was promised
  uint marchedPixels;
  uint rejectedPixels;  // marched because their history was not valid
  uint cells;           // map look-ups of all rays
  uint samples;         // brick samples of all rays
  uint spare0;
  uint spare1;
};

WK_END
