#include "welkin/app/view_flight.h"

#include <algorithm>
#include <cmath>

namespace welkin::app {
namespace {

constexpr double kRho2 = 0.64;         // rho^2 of the paper: how high one flies. A long way peaks at rho^2 / 2 of its length
constexpr double kGroundWidth_m = 30;  // width at the ground: there one does not creep
constexpr double kLeast_s = 0.6, kPath_s = 0.45, kTurn_s_rad = 0.5;  // durations that look unhurried

// Velocity and acceleration are 0 at both ends.
double ease(double x) { return x * x * x * (x * (6 * x - 15) + 10); }

glm::dvec3 anyAcross(const glm::dvec3& n) {
  const glm::dvec3 other = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  return glm::normalize(glm::cross(n, other));
}

glm::dvec3 direction(const glm::dvec3& p) {
  const double r = glm::length(p);
  return r > 0 ? p / r : glm::dvec3(0, 0, 1);
}

}  // namespace

ViewFlight::ViewFlight(const View& from, const View& to, double planetRadius_m) : from_(from), to_(to), radius_m_(planetRadius_m) {
  up_ = direction(from.position_m);
  const glm::dvec3 end = direction(to.position_m), normal = glm::cross(up_, end);
  angle_rad_ = std::atan2(glm::length(normal), glm::dot(up_, end));
  axis_ = glm::length(normal) > 1e-14 ? glm::normalize(normal) : anyAcross(up_);  // the same place or the other side: any way is as good
  arrived_ = glm::angleAxis(-angle_rad_, axis_) * to.orientation;
  if (glm::dot(arrived_, from.orientation) < 0) arrived_ = -arrived_;

  const double altitude0_m = glm::length(from.position_m) - radius_m_, altitude1_m = glm::length(to.position_m) - radius_m_;
  offset_m_ = kGroundWidth_m - std::min({0.0, altitude0_m, altitude1_m});
  width0_m_ = altitude0_m + offset_m_;
  width1_m_ = altitude1_m + offset_m_;
  const double way_m = radius_m_ * angle_rad_;
  straight_ = !(way_m > 1e-12 * std::max(width0_m_, width1_m_));
  if (straight_) {
    length_ = std::abs(std::log(width1_m_ / width0_m_));
  } else {
    const double rise = (width1_m_ - width0_m_) * (width1_m_ + width0_m_), across = kRho2 * kRho2 * way_m * way_m;
    r0_ = -std::asinh((rise + across) / (2 * width0_m_ * kRho2 * way_m));
    length_ = -std::asinh((rise - across) / (2 * width1_m_ * kRho2 * way_m)) - r0_;
  }
  const double turn_rad = 2 * std::acos(std::min(1.0, std::abs(glm::dot(glm::normalize(arrived_), glm::normalize(from.orientation)))));
  duration_s_ = kLeast_s + kPath_s * length_ + kTurn_s_rad * turn_rad;
}

View ViewFlight::at(double time_s) const {
  if (!(time_s > 0)) return from_;
  if (time_s >= duration_s_) return to_;
  const double e = ease(time_s / duration_s_), x = e * length_;
  double width_m, along;  // along: fraction of the great circle
  if (straight_) {
    width_m = width0_m_ * std::pow(width1_m_ / width0_m_, e);
    along = e;
  } else {  // the paper's u(s), with its difference of two large terms gathered into one sinh
    width_m = width0_m_ * std::cosh(r0_) / std::cosh(x + r0_);
    along = std::clamp(width0_m_ / kRho2 * std::sinh(x) / std::cosh(x + r0_) / (radius_m_ * angle_rad_), 0.0, 1.0);
  }
  const glm::dquat carried = glm::angleAxis(along * angle_rad_, axis_);
  View view;
  view.position_m = (carried * up_) * (radius_m_ + width_m - offset_m_);
  view.orientation = glm::normalize(carried * glm::slerp(from_.orientation, arrived_, e));
  view.fov_deg = from_.fov_deg * std::pow(to_.fov_deg / from_.fov_deg, e);
  const bool both = from_.exposure_ev && to_.exposure_ev;
  view.exposure_ev = both ? std::optional(std::lerp(*from_.exposure_ev, *to_.exposure_ev, e)) : from_.exposure_ev;
  return view;
}

}  // namespace welkin::app
