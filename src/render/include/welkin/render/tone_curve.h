#pragma once
// The scene's tone curve: its name in shaders, and the curve itself for the CPU.
#include <glm/glm.hpp>

#include "welkin/physics/scene.h"

namespace welkin {

// The function of tonemap.glsl.h that a shader gets as TONE_CURVE.
const char* toneCurveFunction(ToneCurve curve);

// Exposed linear colour, each at least 0, to linear display colour 0..1.
glm::vec3 toned(ToneCurve curve, glm::vec3 exposed);

// The exposed grey that this curve shows as 0.18 of white.
double middleGrey(ToneCurve curve);

}  // namespace welkin
