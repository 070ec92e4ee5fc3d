#pragma once
// Rays of a picture in double precision: those of shared/camera.glsl.h before they are rounded.
#include <glm/glm.hpp>

#include "welkin/shared/camera.glsl.h"

namespace welkin::reference {

// Distances to a sphere about the planet's centre; near > far: missed, or behind. Inside: near is 0.
struct Stretch {
  double near, far;
  bool empty() const { return !(near < far); }
};
// b = position . direction, c = (distance from the centre)^2 - radius^2, given so that it does not cancel.
Stretch sphereStretch(double b, double c);

struct CameraRay {
  glm::dvec3 position_planet, direction;  // m, unit
  double altitude_m, centre_m, radius_m;  // of the position: above the ground, from the centre; of the ground
  double ground_m;                        // distance to the ground, or -1
};

// Through the middle of pixel (x, y), y from the top.
CameraRay pixelRay(const shared::CameraBlock& camera, int width, int height, int x, int y);
// From anywhere along any unit direction.
CameraRay rayFrom(glm::dvec3 position_planet, glm::dvec3 direction, double radius_m);

}  // namespace welkin::reference
