#include "stress_maker.h"

#include <cmath>
#include <numbers>

#include "welkin/physics/air.h"
#include "welkin/physics/scene_io.h"

namespace welkin::measure {

View look(glm::dvec3 position, glm::dvec3 forward, double fov_deg) {
  View v;
  v.position_m = position;
  const glm::dvec3 f = glm::normalize(forward);
  v.orientation = glm::quatLookAt(f, std::abs(f.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0));
  v.fov_deg = fov_deg;
  return v;
}
View from(double radius, double altitude, double heading_deg, double pitch_deg, double fov_deg, double lat, double lon) {
  return toView({lat, lon, altitude, heading_deg, pitch_deg, 0, fov_deg, {}}, radius);
}
View whole(double radius, double altitude, double lat, double lon) {
  const double half = std::asin(radius / (radius + altitude)) * 180 / std::numbers::pi;
  return from(radius, altitude, 0, -90, std::min(2.4 * half, 150.0), lat, lon);
}

Scene bare(double radius) {
  Scene s;
  s.name = "bare ball";
  s.planet = {radius, {0.5, 0.5, 0.5}, {}};
  s.sun = Sun{{1, 1, 1}, 0.004675, directionTo(10, 40)};
  s.quality.budget_bytes = 64ull << 20;
  return s;
}

Scene clearAir(double radius, double scale_m, double depth, PhaseType phase, double g) {
  Scene s = bare(radius);
  s.name = "one layer of air";
  const double k = depth / scale_m;
  AirLayer layer{"air", ExponentialProfile{scale_m}, {k, k, k}, {0, 0, 0}, phase, g};
  s.atmosphere = Atmosphere{std::max(12.0, 12 + std::log(depth)) * scale_m, "march", {layer}};
  return s;
}

Scene slabClouds(double extinction_per_m, double radius) {
  Scene s = bare(radius);
  s.name = "an even shell of cloud";
  s.clouds = Clouds{{SlabSource{kBase_m, kTop_m, extinction_per_m}}, true};
  s.quality.depth = 13;
  s.quality.detail = 8;
  return s;
}

Scene earth(const char* model) {
  Scene s = bare();
  s.name = "clouds and air";
  s.planet.albedo = {0.06, 0.07, 0.10};
  s.atmosphere = earthAir();
  s.atmosphere->model = model;
  s.clouds = Clouds{{LayersSource{}}, true};
  s.quality.depth = 12;
  s.quality.detail = 8;
  return s;
}

std::vector<double> ShotMaker::some(std::vector<double> all) const {
  if (!quick || all.size() < 4) return all;
  return {all.front(), all[all.size() / 2], all.back()};
}
ShotStage& ShotMaker::stage(Scene scene) {
  if (quick && scene.quality.depth <= 13) scene.quality.budget_bytes = (scene.atmosphere ? 32ull : 24ull) << 20;
  if (quick && scene.quality.detail > 0) scene.quality.detail = scene.atmosphere ? 3 : 6;
  stages.push_back({std::move(scene), quick ? 32 : 48, quick ? 18 : 27, {}, false, false});
  return stages.back();
}

std::deque<ShotStage> stressStages(bool quick) {
  ShotMaker m{quick, {}};
  m.radii(), m.altitudes(), m.places(), m.suns(), m.fields(), m.sizes(), m.grazing(), m.depths(), m.times(), m.densities(), m.airs();
  return std::move(m.stages);
}

}  // namespace welkin::measure
