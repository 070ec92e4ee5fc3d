#pragma once
// The stability matrix as one picture.
#include "welkin/measure/stress.h"
#include "welkin/render/renderer.h"

namespace welkin::app {

// Above: integrators by optical depth per step, the worst of all media; below: every other axis, the default integrator. Colour is the
// logarithm of the error; a cell that fails is crossed, one that has no truth but keeps its bounds is grey.
Image8 stressMap(const measure::StressReport& report);

}  // namespace welkin::app
