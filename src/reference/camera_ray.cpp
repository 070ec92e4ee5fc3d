#include "welkin/reference/camera_ray.h"

#include <cmath>

namespace welkin::reference {

Stretch sphereStretch(double b, double c) {
  const double disc = b * b - c;
  if (disc < 0 || (c > 0 && b >= 0)) return {1, 0};
  const double root = std::sqrt(disc);
  if (c > 0) return {c / (root - b), root - b};
  return {0, b < 0 ? root - b : -c / (b + root)};
}

namespace {

CameraRay finished(CameraRay ray) {
  const Stretch ground = sphereStretch(glm::dot(ray.position_planet, ray.direction), ray.altitude_m * (ray.centre_m + ray.radius_m));
  ray.ground_m = ground.near <= ground.far ? ground.near : -1;
  return ray;
}

}  // namespace

CameraRay pixelRay(const shared::CameraBlock& camera, int width, int height, int x, int y) {
  const double across = 2 * (x + 0.5) / width - 1, up = 1 - 2 * (y + 0.5) / height;
  const glm::dvec3 d = shared::xyz(camera.forward) + shared::xyz(camera.right) * across + shared::xyz(camera.up) * up;
  return finished({shared::xyz(camera.position), glm::normalize(d), camera.position.w, camera.up.w, camera.forward.w, -1});
}

CameraRay rayFrom(glm::dvec3 position_planet, glm::dvec3 direction, double radius_m) {
  const double r = glm::length(position_planet);
  return finished({position_planet, direction, r - radius_m, r, radius_m, -1});
}

}  // namespace welkin::reference
