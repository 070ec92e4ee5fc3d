#include "welkin/app/fly_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "welkin/app/geographic.h"

namespace welkin::app {
namespace {

constexpr double kPiece_s = 1.0 / 64;  // a sixteenth of kDriveTime_s: the quadrature's error is below 1e-10 of the way
constexpr double kLongest_s = 60;      // of a frame: after a suspended machine one is not on the other side of the planet
constexpr double kFarthest_m = 1e12;   // from the centre, as in scene files
constexpr double kStill = 1e-9;        // of full speed: standing
constexpr double kUpright_rad = std::numbers::pi / 2;

double number(double v, double low, double high) { return std::isfinite(v) ? std::clamp(v, low, high) : 0; }

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

FlyInput checked(const FlyInput& in) {
  FlyInput out = in;
  for (int i = 0; i < 3; ++i) out.move[i] = number(in.move[i], -1, 1);
  if (const double l = glm::length(out.move); l > 1) out.move /= l;  // two keys are not faster than one
  for (int i = 0; i < 2; ++i) out.turn_rad[i] = number(in.turn_rad[i], -1e3, 1e3);
  out.roll = number(in.roll, -1, 1);
  out.wheel = number(in.wheel, -100, 100);
  return out;
}

glm::dquat turnAbout(const glm::dvec3& rotation_rad) {
  const double angle = glm::length(rotation_rad);
  return angle > 0 ? glm::angleAxis(angle, rotation_rad / angle) : glm::dquat(1, 0, 0, 0);
}

glm::dvec3 forwardOf(const View& view) { return view.orientation * glm::dvec3(0, 0, -1); }

}  // namespace

const View& FlyCamera::advance(const FlyInput& raw, double dt_s) {
  const FlyInput input = checked(raw);
  dt_s = number(dt_s, 0, kLongest_s);
  speedFactor = std::clamp(speedFactor * std::pow(kWheelFactor, input.wheel), 1 / kSpeedFactorRange, kSpeedFactorRange);
  if (input.move != glm::dvec3(0) || input.turn_rad != glm::dvec2(0) || input.roll != 0) flight_.reset();
  if (flight_) {
    flightTime_s_ += dt_s;
    view_ = flight_->at(flightTime_s_);
    // What is left of the motion before dies away, and is nothing at the end.
    const double part = std::min(1.0, flightTime_s_ / flight_->duration_s()), left = 1 - part * part;
    view_.position_m += glide_m_ * (std::exp(-flightTime_s_ / kDriveTime_s) * left * left);
    keepAboveGround();
    if (flightTime_s_ >= flight_->duration_s()) flight_.reset();
    return view_;
  }
  if (input.turn_rad != glm::dvec2(0)) turn(input);
  steered_ |= input.move != glm::dvec3(0) || input.turn_rad != glm::dvec2(0) || input.roll != 0;
  const int pieces = std::max(1, int(std::ceil(dt_s / kPiece_s)));
  for (int i = 0; i < pieces && dt_s > 0; ++i) {  // the roll half before and half after the way: symmetric, so of second order
    roll(input, dt_s / pieces / 2);
    move(input, dt_s / pieces);
    roll(input, dt_s / pieces / 2);
  }
  return view_;
}

void FlyCamera::turn(const FlyInput& input) {
  const glm::dvec2 a = input.turn_rad;
  if (!input.level) {
    view_.orientation =
        glm::normalize(view_.orientation * glm::angleAxis(-a.x, glm::dvec3(0, 1, 0)) * glm::angleAxis(a.y, glm::dvec3(1, 0, 0)));
    return;
  }
  // Around the zenith, and up no farther than the zenith.
  const glm::dvec3 zenith = up(), forward = forwardOf(view_), top = view_.orientation * glm::dvec3(0, 1, 0);
  const double pitch = std::asin(std::clamp(glm::dot(forward, zenith), -1.0, 1.0));
  const double low = -kUpright_rad - pitch, high = kUpright_rad - pitch;
  const bool upright = glm::dot(top, zenith) > -1e-6;  // at the zenith its sign is rounding
  const double rise = upright ? std::clamp(a.y, low, high) : std::clamp(a.y, -high, -low);
  view_.orientation = glm::normalize(glm::angleAxis(-a.x, zenith) * view_.orientation * glm::angleAxis(rise, glm::dvec3(1, 0, 0)));
}

// angle' = rate - angle / time has a closed form; time grows without end towards the vertical, where there is no upright.
void FlyCamera::roll(const FlyInput& input, double dt_s) {
  const bool levels = input.level && steered_ && !grabbed_;
  if (input.roll == 0 && !levels) return;
  const glm::dvec3 zenith = up(), forward = forwardOf(view_), right = view_.orientation * glm::dvec3(1, 0, 0);
  const glm::dvec3 top = view_.orientation * glm::dvec3(0, 1, 0);
  const double rise = glm::dot(forward, zenith), level2 = std::max(0.0, 1 - rise * rise);
  const double angle = -std::atan2(glm::dot(right, zenith), glm::dot(top, zenith));  // clockwise
  const double perTime = levels ? level2 / kLevelTime_s : 0;
  const double done = perTime * dt_s > 1e-12 ? -std::expm1(-perTime * dt_s) : perTime * dt_s;
  const double change = (perTime > 0 ? done / perTime : dt_s) * kRollRate_rad_s * input.roll - angle * done;
  if (std::abs(change) < 1e-15) return;
  view_.orientation = glm::normalize(view_.orientation * glm::angleAxis(-change, glm::dvec3(0, 0, 1)));
}

void FlyCamera::move(const FlyInput& input, double dt_s) {
  const glm::dvec3 zenith = up();
  glm::dvec3 wanted = view_.orientation * glm::dvec3(input.move.x, 0, input.move.z);
  wanted += (input.level ? zenith : view_.orientation * glm::dvec3(0, 1, 0)) * input.move.y;
  wanted *= speedFactor * (input.fast ? kFastFactor : 1);
  if (wanted == glm::dvec3(0) && glm::length(drive_) < kStill) {
    drive_ = glm::dvec3(0);
    return;
  }
  // drive' = (wanted - drive) / kDriveTime_s in axes that the planet's curve carries along, and its integral.
  const glm::dvec3 start = drive_;
  const auto driveAt = [&](double t) { return wanted + (start - wanted) * std::exp(-t / kDriveTime_s); };
  const auto wayAt = [&](double t) { return wanted * t - (start - wanted) * (kDriveTime_s * std::expm1(-t / kDriveTime_s)); };

  // Height: (h + h0)' = k (h + h0) drive.zenith is exact for any drive.
  const double ground_m = groundAt(zenith), scale_m = groundScale_m();
  const double start_m = std::max(kEyeHeight_m, glm::length(view_.position_m) - radius_m_ - ground_m);
  const auto heightAt = [&](double t) {
    const double h = (start_m + scale_m) * std::exp(kSpeed_per_s * glm::dot(wayAt(t), zenith)) - scale_m;
    return std::clamp(h, kEyeHeight_m, kFarthest_m);
  };
  // Turning around the centre: Magnus expansion of fourth order on two Gauss points (Iserles and others, Acta Numerica 2000, 2.4 and 5).
  const auto turningAt = [&](double t) {
    const double h = heightAt(t);
    return glm::cross(zenith, driveAt(t)) * (kSpeed_per_s * (h + scale_m) / (radius_m_ + ground_m + h));
  };
  const double gauss = std::sqrt(3.0) / 6;
  const glm::dvec3 first = turningAt(dt_s * (0.5 - gauss)), second = turningAt(dt_s * (0.5 + gauss));
  const glm::dquat carried = turnAbout(dt_s / 2 * (first + second) + gauss / 2 * dt_s * dt_s * glm::cross(first, second));

  const double altitude_m = ground_m + heightAt(dt_s);
  drive_ = carried * driveAt(dt_s);
  view_.position_m = glm::normalize(carried * zenith) * std::min(radius_m_ + altitude_m, kFarthest_m);
  view_.orientation = glm::normalize(carried * view_.orientation);
  keepAboveGround();
}

void FlyCamera::keepAboveGround() {
  const double r = glm::length(view_.position_m);
  const glm::dvec3 zenith = r > 0 ? view_.position_m / r : glm::dvec3(0, 0, 1);  // at the centre: out by the north pole
  const double lowest_m = radius_m_ + groundAt(zenith) + kEyeHeight_m;
  if (r < lowest_m) view_.position_m = zenith * lowest_m;
}

double FlyCamera::groundScale_m() const { return std::min(kGroundScale_m, radius_m_ / 100); }

bool FlyCamera::setView(const View& view) {
  const glm::dquat q = view.orientation;
  const double norm = glm::length(q);
  if (!finite(view.position_m) || !(std::isfinite(norm) && norm > 0) || !(view.fov_deg > 0 && view.fov_deg < 180)) return false;
  stop();
  view_ = view;
  if (std::abs(norm - 1) > 1e-12) view_.orientation = q / norm;  // else to the bit, as it came
  if (const double r = glm::length(view_.position_m); r > kFarthest_m) view_.position_m *= kFarthest_m / r;
  keepAboveGround();
  return true;
}

void FlyCamera::setLens(double fov_deg, std::optional<double> exposure_ev) {
  if (!(fov_deg > 0 && fov_deg < 180)) return;
  view_.fov_deg = fov_deg;
  view_.exposure_ev = exposure_ev;
}

void FlyCamera::setPlanetRadius(double radius_m) {
  radius_m_ = radius_m;
  stop();
  keepAboveGround();
}

void FlyCamera::setGround(std::function<double(const glm::dvec3&)> altitude_m) {
  ground_ = std::move(altitude_m);
  keepAboveGround();
}

double FlyCamera::altitude_m() const { return glm::length(view_.position_m) - radius_m_; }
double FlyCamera::height_m() const { return altitude_m() - groundAt(up()); }

glm::dvec3 FlyCamera::velocity_m_s() const {
  const double h = height_m();
  glm::dvec3 v = drive_ * (kSpeed_per_s * (h + groundScale_m()));
  if (h <= kEyeHeight_m * (1 + 1e-6)) v -= up() * std::min(0.0, glm::dot(v, up()));  // the ground holds
  return v;
}

void FlyCamera::flyTo(const View& view) {
  FlyCamera there(radius_m_);
  if (!there.setView(view)) return;
  // Without a jerk: from where it would come to rest, and from there on away from where it is as fast as it went.
  const View now = view_;
  view_.position_m += velocity_m_s() * kDriveTime_s;
  keepAboveGround();
  glide_m_ = now.position_m - view_.position_m;
  stop();
  flight_.emplace(view_, there.view(), radius_m_);
  view_ = now;
  flightTime_s_ = 0;
}

void FlyCamera::goTo(double latitude_deg, double longitude_deg, double altitude_m) {
  GeographicView g = toGeographic(view_, radius_m_);
  g.latitude_deg = number(latitude_deg, -90, 90);
  g.longitude_deg = number(longitude_deg, -360, 360);
  g.altitude_m = number(altitude_m, kEyeHeight_m, kFarthest_m);
  flyTo(toView(g, radius_m_));
}

void FlyCamera::stop() {
  drive_ = glm::dvec3(0);
  flight_.reset();
  steered_ = false;
}

}  // namespace welkin::app
