#include "welkin/app/sun_place.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>

namespace welkin::app {
namespace {

constexpr double kRad = std::numbers::pi / 180;

struct Compass {
  glm::dvec3 zenith, east, north;
};
Compass compassAt(double latitude_deg, double longitude_deg) {
  const glm::dvec3 zenith = directionTo(latitude_deg, longitude_deg), east = directionTo(0, longitude_deg + 90);
  return {zenith, east, glm::cross(zenith, east)};
}

}  // namespace

SunInSky sunInSky(const glm::dvec3& direction, double latitude_deg, double longitude_deg) {
  const auto [zenith, east, north] = compassAt(latitude_deg, longitude_deg);
  const double e = glm::dot(direction, east), n = glm::dot(direction, north);
  const double azimuth_deg = std::atan2(e, n) / kRad;
  return {std::atan2(glm::dot(direction, zenith), std::hypot(e, n)) / kRad, azimuth_deg < 0 ? azimuth_deg + 360 : azimuth_deg};
}

glm::dvec3 sunDirection(const SunInSky& sun, double latitude_deg, double longitude_deg) {
  const auto [zenith, east, north] = compassAt(latitude_deg, longitude_deg);
  const double up = sun.elevation_deg * kRad, around = sun.azimuth_deg * kRad;
  return glm::normalize(std::cos(up) * (std::cos(around) * north + std::sin(around) * east) + std::sin(up) * zenith);
}

glm::dvec3 sunDirectionAt(double days) {
  const auto point = subsolarPoint(days);
  return directionTo(point.latitude_deg, point.longitude_deg);
}

std::string utcText(double days) {
  using namespace std::chrono;
  if (!(std::abs(days) < 150'000)) return {};
  const auto moment = sys_days(year(2000) / January / 1) + hours(12) + milliseconds(std::llround(days * 86'400'000));
  const auto date = floor<std::chrono::days>(moment);
  const year_month_day d(date);
  if (int(d.year()) < 1600 || int(d.year()) > 2400) return {};
  const std::int64_t ms = duration_cast<milliseconds>(moment - date).count();
  std::string out = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", int(d.year()), unsigned(d.month()), unsigned(d.day()),
                                ms / 3'600'000, ms / 60'000 % 60, ms / 1000 % 60);
  if (ms % 1000 != 0) out += fmt::format(".{:03}", ms % 1000);
  return out + "Z";
}

}  // namespace welkin::app
