#pragma once
// A whole planet that a test can afford: procedural weather (no data file), default layers, air, sun, a small budget.
#include <cmath>

#include "welkin/physics/air.h"
#include "welkin/physics/scene.h"
#include "welkin/physics/scene_io.h"

namespace welkin::test {

inline constexpr double kEarthRadius_m = 6'360'000;

inline Scene smallEarth() {
  Scene scene;
  scene.name = "small Earth";
  scene.planet.radius_m = kEarthRadius_m;
  scene.atmosphere = earthAir();
  scene.sun = Sun{};
  scene.sun->direction_planet = directionTo(20, -30);
  scene.clouds = Clouds{{LayersSource{}}, true};
  scene.quality.budget_bytes = 64ull << 20;
  scene.quality.depth = 11;
  return scene;
}

// The same without anything but a ball.
inline Scene bareBall() {
  Scene scene;
  scene.name = "bare ball";
  scene.planet.radius_m = kEarthRadius_m;
  return scene;
}

inline View viewAt(double latitude_deg, double longitude_deg, double altitude_m, double heading_deg, double pitch_deg,
                   double fov_deg = 58) {
  return toView({latitude_deg, longitude_deg, altitude_m, heading_deg, pitch_deg, 0, fov_deg, {}}, kEarthRadius_m);
}

}  // namespace welkin::test
