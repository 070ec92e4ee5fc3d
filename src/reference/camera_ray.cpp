#include "welkin/reference/camera_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace welkin::reference {

Stretch sphereStretch(double b, double c) {
  const double disc = b * b - c;
  if (disc < 0 || (c > 0 && b >= 0)) return {1, 0};
  const double root = std::sqrt(disc);
  if (c > 0) return {c / (root - b), root - b};
  return {0, b < 0 ? root - b : -c / (b + root)};
}

namespace {

constexpr double kOnGround_m = 1e-6;  // rounding of an Earth's radius is 1e-9 m

CameraRay finished(CameraRay ray) {
  const double b = glm::dot(ray.position_planet, ray.direction);
  const Stretch ground = sphereStretch(b, ray.altitude_m * (ray.centre_m + ray.radius_m));
  ray.ground_m = ground.near <= ground.far ? ground.near : -1;
  if (std::abs(ray.altitude_m) <= kOnGround_m) ray.ground_m = b < 0 ? 0 : -1;
  return ray;
}

double smoothstep(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

Stretch cubeStretch(glm::dvec3 start, glm::dvec3 slope, glm::dvec3 corner, double size) {
  Stretch s{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (int a = 0; a < 3; ++a) {
    const double low = corner[a] - start[a], high = low + size;
    if (slope[a] == 0) {
      if (low > 0 || high < 0) s.near = std::numeric_limits<double>::infinity();
      continue;
    }
    s.near = std::max(s.near, (slope[a] > 0 ? low : high) / slope[a]);
    s.far = std::min(s.far, (slope[a] > 0 ? high : low) / slope[a]);
  }
  return s;
}

Stretch shellStretch(const CameraRay& ray, double base_m, double top_m) {
  const double b = glm::dot(ray.position_planet, ray.direction), h = ray.altitude_m, r = ray.centre_m, R = ray.radius_m;
  Stretch s = sphereStretch(b, (h - top_m) * (r + R + top_m));
  if (s.empty()) return s;
  if (ray.ground_m >= 0) s.far = std::min(s.far, ray.ground_m);
  if (!(base_m > -R)) return s;
  const Stretch inner = sphereStretch(b, (h - base_m) * (r + R + base_m));
  if (inner.empty()) return s;
  if (h < base_m) {
    s.near = std::max(s.near, inner.far);
  } else if (ray.ground_m >= 0) {
    s.far = std::min(s.far, inner.near);
  }
  return s;
}

double limbShare(const CameraRay& ray) {
  const double cosine = ray.ground_m >= 0 ? -glm::dot(ray.position_planet + ray.direction * ray.ground_m, ray.direction) / ray.radius_m : 0;
  return (1 - smoothstep(0, 0.12, cosine)) * smoothstep(50e3, 250e3, ray.altitude_m);
}

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
