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

// Where a line is within the cube of edge `size` from `corner` on; empty if it misses it. `far` holds along a face too, on either side of it.
Stretch cubeStretch(glm::dvec3 start, glm::dvec3 slope, glm::dvec3 corner, double size);

// Where a ray is between two altitudes, and not behind the ground: from below the base it begins there, from above onto the ground it
// ends there.
Stretch shellStretch(const CameraRay& ray, double base_m, double top_m);

// How much a ray is one past the limb, seen from outside (cloud_march.glsl): there cloud that coarse voxels carry above the source's top is
// left out. Part of what is shown, so the reference has it too.
double limbShare(const CameraRay& ray);

}  // namespace welkin::reference
