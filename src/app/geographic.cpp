#include "welkin/app/geographic.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace welkin::app {
namespace {
constexpr double kDeg = 180 / std::numbers::pi;
}

GeographicView toGeographic(const View& view, double planetRadius_m) {
  const glm::dvec3 p = view.position_m;
  GeographicView g;
  g.altitude_m = glm::length(p) - planetRadius_m;
  g.latitude_deg = std::atan2(p.z, std::hypot(p.x, p.y)) * kDeg;
  g.longitude_deg = p.x == 0 && p.y == 0 ? 0 : std::atan2(p.y, p.x) * kDeg;

  const glm::dvec3 zenith = directionTo(g.latitude_deg, g.longitude_deg);
  const glm::dvec3 east = glm::normalize(directionTo(0, g.longitude_deg + 90)), north = glm::cross(zenith, east);
  const glm::dvec3 forward = view.orientation * glm::dvec3(0, 0, -1), up = view.orientation * glm::dvec3(0, 1, 0);
  const double rise = glm::dot(forward, zenith), level = std::hypot(glm::dot(forward, east), glm::dot(forward, north));
  g.pitch_deg = std::atan2(rise, level) * kDeg;
  const bool vertical = level < 1e-12;  // the compass of such a forward is rounding alone
  const glm::dvec3 ahead = !vertical ? forward : rise < 0 ? up : -up;
  g.heading_deg = std::atan2(glm::dot(ahead, east), glm::dot(ahead, north)) * kDeg;
  if (g.heading_deg < 0) g.heading_deg += 360;
  if (!vertical) {
    const glm::dvec3 rightLevel = glm::normalize(glm::cross(forward, zenith)), upLevel = glm::cross(rightLevel, forward);
    g.roll_deg = std::atan2(glm::dot(up, rightLevel), glm::dot(up, upLevel)) * kDeg;
  }
  g.fov_deg = view.fov_deg;
  g.exposure_ev = view.exposure_ev;
  return g;
}

std::string placeText(const GeographicView& g) {
  return fmt::format("{:.2f} {} {:.2f} {}", std::abs(g.latitude_deg), g.latitude_deg < 0 ? 'S' : 'N', std::abs(g.longitude_deg),
                     g.longitude_deg < 0 ? 'W' : 'E');
}

std::string lengthText(double length_m) {
  const double km = length_m / 1000;
  if (std::abs(length_m) < 999.5) return fmt::format("{:.{}f} m", length_m, std::abs(length_m) < 99.5 ? 1 : 0);
  return fmt::format("{:.{}f} km", km, std::abs(km) < 9.95 ? 2 : std::abs(km) < 99.5 ? 1 : 0);
}

}  // namespace welkin::app
