#pragma once
// An Earth with the air that published comparisons use, cameras around it, and a plain march in double as the truth for one ray.
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

#include "welkin/physics/air.h"
#include "welkin/physics/scene.h"
#include "welkin/shared/camera.glsl.h"

namespace welkin::test {

constexpr double kDegree = std::numbers::pi / 180;

// Sun at zenith angle `sunZenith_rad` for a camera above the north pole (+Z), towards +X.
inline Scene skyScene(double sunZenith_rad) {
  Scene scene;
  scene.planet.radius_m = 6'360'000;
  scene.atmosphere = earthAir();
  scene.sun = Sun{};
  scene.sun->direction_planet = {std::sin(sunZenith_rad), 0, std::cos(sunZenith_rad)};
  return scene;
}

// Above the pole at this altitude; azimuth from the sun's side (+X) towards +Y, pitch above the horizontal.
inline shared::CameraBlock cameraOver(const Scene& scene, double altitude_m, double azimuth_rad, double pitch_rad, double fovY_rad,
                                      double aspect) {
  const double r = scene.planet.radius_m + altitude_m;
  const glm::dvec3 forward{std::cos(pitch_rad) * std::cos(azimuth_rad), std::cos(pitch_rad) * std::sin(azimuth_rad), std::sin(pitch_rad)};
  const glm::dvec3 right{std::sin(azimuth_rad), -std::cos(azimuth_rad), 0};
  const glm::dvec3 up = glm::cross(right, forward);
  const double t = std::tan(fovY_rad / 2);
  const double top = scene.atmosphere ? scene.atmosphere->top_m : 20'000;
  return {{0, 0, r, altitude_m},
          {forward.x, forward.y, forward.z, scene.planet.radius_m},
          {right.x * t * aspect, right.y * t * aspect, right.z * t * aspect, top},
          {up.x * t, up.y * t, up.z * t, r}};
}

}  // namespace welkin::test
