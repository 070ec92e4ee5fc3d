// What rays of a view may meet, from cones and spheres.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "welkin/physics/air.h"
#include "welkin/render/frame_plan.h"

namespace welkin {
namespace {

constexpr double kSlack_rad = 1e-4;  // rounding of single-precision rays: 1e-7, and generously more
constexpr double kShell_m = 20'000;  // clouds end here (the octree's root), stored ones from space at the source's top:
constexpr double kSpace_m = 250'000;  // from this altitude on (kLimbFull_m in cloud_march.glsl)
// A point gets light scattered n times while the sun is at most (2 n - 1) dips of the shell's horizon below its own. Five leave out
// what was scattered at least four times, always through the shell's limb: under 1e-6 of the sun for any air.
constexpr double kTwilightDips = 5;
// Sunlight times exposure up to which 1e-6 of it shows as black: 8 (kBaseExposure) times 12.92 (the slope of sRGB) times that is 0.4 / 255.
constexpr double kBrightest = 16;

double angle(const glm::dvec3& a, const glm::dvec3& b) { return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)); }

}  // namespace

Sight sightOf(const Scene& scene, const View& view, double aspect) {
  const double R = scene.planet.radius_m, r = std::max(glm::length(view.position_m), R);
  const glm::dvec3 up = glm::length(view.position_m) > 0 ? glm::normalize(view.position_m) : glm::dvec3(0, 0, 1);
  const double tanY = std::tan(view.fov_deg * std::numbers::pi / 360);
  const double half_rad = std::atan(tanY * std::hypot(1.0, aspect)) + kSlack_rad;  // to the picture's corners
  const double off_rad = angle(view.orientation * glm::dvec3(0, 0, -1), -up);      // from straight down
  const auto meets = [&](double radius_m) { return radius_m >= r || off_rad - half_rad <= std::asin(radius_m / r); };

  const bool clouds = scene.clouds && !scene.clouds->sources.empty(), air = scene.atmosphere && !scene.atmosphere->layers.empty();
  const double top_m = std::max(clouds ? kShell_m : 0.0, air ? airTop_m(scene) : 0.0);
  Sight sight;
  sight.ground = meets(R);
  sight.shell = (clouds && r < R + kSpace_m) || meets(R + top_m);
  if (!scene.sun) return sight;
  const glm::dvec3 toSun = glm::normalize(scene.sun->direction_planet);
  const double dip_rad = std::acos(R / (R + top_m));
  const double seen_rad = std::acos(R / r) + dip_rad;  // how far along the ground the camera sees
  const double dark_rad = std::numbers::pi / 2 + kTwilightDips * dip_rad + scene.sun->angularRadius_rad + kSlack_rad;
  sight.lit = angle(up, toSun) - seen_rad <= dark_rad;
  return sight;
}

std::optional<LeftOut> nothingSeen(const Scene& scene, const PlanFor& asked) {
  const bool clouds = scene.clouds && !scene.clouds->sources.empty();
  if (!asked.view || (!clouds && (!scene.atmosphere || scene.atmosphere->layers.empty()))) return {};
  const Sight sight = sightOf(scene, *asked.view, asked.aspect);
  const char* what = "streaming, light, sky tables of the view, march: the ground, the sun and black are drawn";
  if (!sight.shell && !asked.forced.contains("looking-away")) return LeftOut{what, "the camera is above air and clouds and looks past them", "looking-away"};
  // A meter would turn up what little light there is, and who reads numbers may look for it.
  const auto ev = asked.view->exposure_ev ? asked.view->exposure_ev : scene.output.exposure_ev;
  const Spectrum3 light = scene.sun ? scene.sun->irradiance : Spectrum3{};
  const bool dark = ev && *std::max_element(light.begin(), light.end()) * std::exp2(*ev) <= kBrightest;
  if (!sight.lit && dark && !asked.linear && !asked.forced.contains("night"))
    return LeftOut{what, "the sun is so far below all that is seen that its light, scattered, is black", "night"};
  return {};
}

}  // namespace welkin
