#pragma once
// Directions drawn at random.
#include <glm/glm.hpp>

#include "welkin/physics/scene.h"
#include "welkin/reference/random.h"

namespace welkin::reference {

// Cosine of a scattering angle with density 2 pi phase(type, g, c), exactly.
double samplePhase(PhaseType type, double g, PathNumbers& numbers);

// Unit vector at an angle (its cosine) from a unit axis, turned about it by `turn` (0 to 1).
glm::dvec3 directionAbout(glm::dvec3 axis, double cosine, double turn);

}  // namespace welkin::reference
