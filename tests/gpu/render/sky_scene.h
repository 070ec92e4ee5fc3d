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
  scene.atmosphere = Atmosphere{
      100'000,
      "auto",
      {{"rayleigh", ExponentialProfile{8000}, {5.802e-6, 13.558e-6, 33.1e-6}, {}, PhaseType::Rayleigh, 0},
       {"mie", ExponentialProfile{1200}, {3.996e-6, 3.996e-6, 3.996e-6}, {0.444e-6, 0.444e-6, 0.444e-6}, PhaseType::CornetteShanks, 0.8},
       {"ozone", TentProfile{25'000, 15'000}, {}, {0.650e-6, 1.881e-6, 0.085e-6}, PhaseType::Isotropic, 0}}};
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

// Multiple-scattering source read back from the GPU, interpolated as the shader does.
struct MultipleTable {
  std::vector<glm::vec4> texels;
  glm::dvec3 at(const shared::AirParams& air, double altitude_m, double muSun) const {
    const double x = shared::sunCoord(static_cast<float>(muSun)) * (shared::kSunTexels - 1.0);
    const double y = shared::altitudeCoord(air, static_cast<float>(altitude_m)) * (shared::kAltitudeTexels - 1.0);
    const int x0 = std::min(static_cast<int>(x), static_cast<int>(shared::kSunTexels) - 2),
              y0 = std::min(static_cast<int>(y), static_cast<int>(shared::kAltitudeTexels) - 2);
    const auto get = [&](int i, int j) { return glm::dvec3(texels[static_cast<std::size_t>(j) * shared::kSunTexels + i]); };
    const double fx = x - x0, fy = y - y0;
    return glm::mix(glm::mix(get(x0, y0), get(x0 + 1, y0), fx), glm::mix(get(x0, y0 + 1), get(x0 + 1, y0 + 1), fx), fy);
  }
};

struct TrueAir {
  glm::dvec3 inscatter{0}, transmittance{1};
};

// Sun's light at a point: air towards the sun and the exact visible area of its disc at the planet's edge.
inline glm::dvec3 trueSun(const shared::AirBlock& air, double altitude_m, double muSun) {
  const double radius = air.params.radius_m, r = radius + altitude_m;
  const double horizon = -std::sqrt(altitude_m * (2 * radius + altitude_m)) / r;
  const double x = std::clamp((std::acos(horizon) - std::acos(muSun)) / air.params.sunRadius_rad, -1.0, 1.0);
  const double visible = 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / std::numbers::pi;
  if (visible <= 0) return glm::dvec3(0);
  const auto depth = shared::airOpticalDepthToTop(air, static_cast<float>(altitude_m), static_cast<float>(std::max(muSun, horizon)), 60);
  return visible * glm::exp(-glm::dvec3(depth));
}

// From `origin` (planet frame, m) along unit `dir` to `distance_m`, the ground or the end of the air. Midpoint steps, denser at both ends.
inline TrueAir trueAir(const shared::AirBlock& air, const MultipleTable& multiple, glm::dvec3 origin, glm::dvec3 dir, glm::dvec3 toSun,
                       double distance_m, int steps = 1200) {
  const double radius = air.params.radius_m, top = radius + air.params.top_m;
  const double b = glm::dot(origin, dir), rr = glm::dot(origin, origin);
  const double disc = b * b - (rr - top * top);
  TrueAir sum;
  if (disc <= 0) return sum;
  const double begin = std::max(-b - std::sqrt(disc), 0.0);
  double end = std::min(-b + std::sqrt(disc), distance_m);
  const double ground = b * b - (rr - radius * radius);
  if (b < 0 && ground >= 0) end = std::min(end, -b - std::sqrt(ground));
  if (end <= begin) return sum;
  const auto place = [&](double x) { return begin + (end - begin) * x * x * (3 - 2 * x); };
  double phases[shared::kMaxAirLayers];
  const double cosine = glm::dot(dir, toSun);
  for (std::uint32_t i = 0; i < air.params.layerCount; ++i)
    phases[i] = shared::phaseValue(air.layers[i].phase, air.layers[i].g, static_cast<float>(cosine));
  for (int i = 0; i < steps; ++i) {
    const double t0 = place(double(i) / steps), dt = place(double(i + 1) / steps) - t0;
    const glm::dvec3 p = origin + dir * (t0 + 0.5 * dt);
    const double r = glm::length(p), h = std::max(r - radius, 0.0), muSun = glm::dot(p, toSun) / r;
    glm::dvec3 extinction(0), phased(0), scattering(0);
    for (std::uint32_t k = 0; k < air.params.layerCount; ++k) {
      const double density = shared::layerDensity(air.layers[k], static_cast<float>(h));
      extinction += glm::dvec3(shared::layerExtinction(air.layers[k])) * density;
      scattering += glm::dvec3(shared::layerScattering(air.layers[k])) * density;
      phased += glm::dvec3(shared::layerScattering(air.layers[k])) * density * phases[k];
    }
    const glm::dvec3 source = phased * trueSun(air, h, muSun) + scattering * multiple.at(air.params, h, muSun);
    const glm::dvec3 tau = extinction * dt;
    sum.inscatter += sum.transmittance * source * dt * (1.0 - tau * (0.5 - tau / 6.0));
    sum.transmittance *= glm::exp(-tau);
  }
  return sum;
}

}  // namespace welkin::test
