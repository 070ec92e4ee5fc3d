#pragma once
// Airs with known answers.
#include <gtest/gtest.h>

#include <numbers>

#include "welkin/physics/probe.h"
#include "welkin/reference/medium.h"

namespace welkin::reference {

constexpr double kPi = std::numbers::pi, kDeg = kPi / 180;

inline Scene sceneOf(double radius_m, double top_m, std::vector<AirLayer> layers, Spectrum3 albedo = {}, double sunRadius_rad = 0) {
  Scene scene;
  scene.planet.radius_m = radius_m;
  scene.planet.albedo = albedo;
  scene.atmosphere = Atmosphere{top_m, "auto", std::move(layers)};
  scene.sun = Sun{};
  scene.sun->angularRadius_rad = sunRadius_rad;
  return scene;
}
inline Medium mediumOf(double radius_m, double top_m, std::vector<AirLayer> layers, Spectrum3 albedo = {}, double sunRadius_rad = 0) {
  auto medium = makeMedium(sceneOf(radius_m, top_m, std::move(layers), albedo, sunRadius_rad));
  EXPECT_TRUE(medium.ok());
  return *medium;
}

// Of the Earth: molecules, haze, ozone, as published and used in comparisons of sky models.
inline Medium earth(double sunRadius_rad = 0, Spectrum3 albedo = {0.06, 0.07, 0.10}) {
  return mediumOf(
      6'360'000, 100'000,
      {{"rayleigh", ExponentialProfile{8000}, {5.802e-6, 13.558e-6, 33.1e-6}, {}, PhaseType::Rayleigh, 0},
       {"mie", ExponentialProfile{1200}, {3.996e-6, 3.996e-6, 3.996e-6}, {0.444e-6, 0.444e-6, 0.444e-6}, PhaseType::CornetteShanks, 0.8},
       {"ozone", TentProfile{25'000, 15'000}, {}, {0.650e-6, 1.881e-6, 0.085e-6}, PhaseType::Isotropic, 0}},
      albedo, sunRadius_rad);
}

inline ProbeRay probeRay(double altitude_m, double sun_deg, double view_deg, double azimuth_deg) {
  ProbeRay ray;
  ray.altitude_m = altitude_m;
  ray.sunZenith_rad = sun_deg * kDeg, ray.viewZenith_rad = view_deg * kDeg, ray.azimuth_rad = azimuth_deg * kDeg;
  return ray;
}

}  // namespace welkin::reference
