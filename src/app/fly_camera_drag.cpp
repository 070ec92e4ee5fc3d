// Orbit drag: the planet's point under the cursor stays there.
#include <cmath>
#include <numbers>

#include "welkin/app/fly_camera.h"

namespace welkin::app {
namespace {

// The least turn that brings one unit vector onto another; exact to the last bits for the smallest angles.
glm::dquat turnOnto(const glm::dvec3& from, const glm::dvec3& to) {
  const double w = 1 + glm::dot(from, to);
  if (w < 1e-12) return glm::dquat(1, 0, 0, 0);  // opposite: no way is the least
  const glm::dvec3 axis = glm::cross(from, to);
  return glm::normalize(glm::dquat(w, axis.x, axis.y, axis.z));
}

}  // namespace

glm::dvec3 directionThrough(const View& view, glm::dvec2 point, double aspect) {
  const double tangent = std::tan(view.fov_deg * std::numbers::pi / 360);
  return glm::normalize(glm::dvec3(point.x * tangent * aspect, point.y * tangent, -1));
}

void FlyCamera::release() {
  steered_ |= grabbed_.has_value();
  grabbed_.reset();
}

// The sphere through the ground below; past the limb the ray's nearest point to the centre, which at the limb is the same.
std::optional<glm::dvec3> FlyCamera::pointUnder(const glm::dvec3& direction_view) const {
  const glm::dvec3 d = glm::normalize(view_.orientation * direction_view), p = view_.position_m;
  const double radius_m = radius_m_ + groundAt(up()), b = glm::dot(p, d);
  if (!(b < 0)) return std::nullopt;  // away from the planet
  const glm::dvec3 nearest = p - b * d;
  const double past2 = glm::dot(nearest, nearest) - radius_m * radius_m;
  if (past2 >= 0) return glm::normalize(nearest);
  // The near root as c / (-b + root), without the difference of two great numbers.
  const double r = glm::length(p), t = (r - radius_m) * (r + radius_m) / (-b + std::sqrt(-past2));
  return glm::normalize(p + t * d);
}

bool FlyCamera::grab(const glm::dvec3& direction_view) {
  grabbed_ = pointUnder(direction_view);
  if (grabbed_) stop();
  return grabbed_.has_value();
}

void FlyCamera::drag(const glm::dvec3& direction_view) {
  if (!grabbed_) return;
  const auto now = pointUnder(direction_view);
  if (!now) return;
  const glm::dquat carried = turnOnto(*now, *grabbed_);
  view_.position_m = glm::normalize(carried * view_.position_m) * glm::length(view_.position_m);
  view_.orientation = glm::normalize(carried * view_.orientation);
  keepAboveGround();
}

}  // namespace welkin::app
