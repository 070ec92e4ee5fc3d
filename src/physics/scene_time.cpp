#include "welkin/physics/scene_time.h"

#include <cmath>
#include <numbers>

namespace welkin {
namespace {

constexpr double kTurn_rad = 2 * std::numbers::pi;

// 0 to 1, of the turn that has begun; whole turns go first, so that late times lose nothing but their own last digits.
double partOfTurn(double time_s, double turn_s) {
  const double part = std::fmod(time_s, turn_s) / turn_s;
  return part < 0 ? part + 1 : part;
}

double sunTurn_rad(const Sun& sun, double time_s) { return sun.day_s == 0 ? 0 : -kTurn_rad * partOfTurn(time_s, sun.day_s); }

}  // namespace

glm::dvec3 sunAt(const Sun& sun, double time_s) { return turned(sun.direction_planet, sunTurn_rad(sun, time_s)); }

glm::dvec3 sunStartOf(const Sun& sun, glm::dvec3 toSun, double time_s) { return turned(toSun, -sunTurn_rad(sun, time_s)); }

Scene atTime(Scene scene, double time_s) {
  if (scene.sun) scene.sun->direction_planet = sunAt(*scene.sun, time_s);
  return scene;
}

double windTurn_rad(const Scene& scene, double time_s) {
  if (!scene.clouds || scene.clouds->windEast_m_per_s == 0) return 0;
  return kTurn_rad * partOfTurn(time_s, kTurn_rad * scene.planet.radius_m / scene.clouds->windEast_m_per_s);
}

glm::dvec3 turned(glm::dvec3 x, double east_rad) {
  if (east_rad == 0) return x;
  const double c = std::cos(east_rad), s = std::sin(east_rad);
  return {c * x.x - s * x.y, s * x.x + c * x.y, x.z};
}

View turned(const View& view, double east_rad) {
  if (east_rad == 0) return view;
  View out = view;
  out.position_m = turned(view.position_m, east_rad);
  out.orientation = glm::dquat(std::cos(east_rad / 2), 0, 0, std::sin(east_rad / 2)) * view.orientation;
  return out;
}

}  // namespace welkin
