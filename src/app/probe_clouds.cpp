#include "probe_clouds.h"

#include <cmath>
#include <memory>

#include "welkin/app/draw.h"
#include "welkin/render/sky/sky_probe.h"

namespace welkin::app {
namespace {

constexpr double kStep = 0.05;        // of the march: a probe measures, and one pixel is cheap; the default is up to 0.04 off in transmittance
constexpr double kPixel_deg = 0.001;  // of the picture: 1.7 mm a kilometre away

View pixelView(const Scene& scene, const ProbeRay& ray, const ProbeDirections& d) {
  View view;
  view.position_m = d.up * (scene.planet.radius_m + ray.altitude_m);
  const glm::dvec3 across = std::abs(d.view.z) < 0.7 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);  // any that is not along the ray
  view.orientation = glm::quatLookAt(glm::normalize(d.view), across);
  view.fov_deg = kPixel_deg;
  view.exposure_ev = 0;
  return view;
}

}  // namespace

ProbeDirections directionsOf(const ProbeRay& ray) {
  const double sinLat = std::sin(ray.latitude_rad), cosLat = std::cos(ray.latitude_rad);
  const double sinLon = std::sin(ray.longitude_rad), cosLon = std::cos(ray.longitude_rad);
  const glm::dvec3 up{cosLat * cosLon, cosLat * sinLon, sinLat}, south{sinLat * cosLon, sinLat * sinLon, -cosLat};
  const glm::dvec3 side = glm::cross(up, south);
  const double sinView = std::sin(ray.viewZenith_rad);
  return {up, up * std::cos(ray.sunZenith_rad) + south * std::sin(ray.sunZenith_rad),
          up * std::cos(ray.viewZenith_rad) + sinView * (south * std::cos(ray.azimuth_rad) + side * std::sin(ray.azimuth_rad))};
}

Result<std::vector<ProbeResult>> probeClouds(Scene scene, const std::vector<ProbeRay>& rays, const CommonOptions& options) {
  for (const ProbeRay& ray : rays)
    if (std::isfinite(ray.maxDistance_m)) return Error{"max_distance_m ends rays through clear air only, and the scene has clouds"};
  scene.sun = Sun{{1, 1, 1}, 0, {1, 0, 0}};
  scene.output.exposure_ev = 0;
  scene.quality.step = std::min(scene.quality.step, kStep);
  RenderSettings settings;
  settings.width = settings.height = 1;
  settings.timing = false;
  std::vector<ProbeResult> results(rays.size());
  if (scene.atmosphere) {
    auto context = gpu::Context::createHeadless(options.gpu);
    if (!context) return context.error();
    gpu::MemoryAccount account(scene.quality.budget_bytes);
    auto tables = SkyTables::create(account, scene);
    if (!tables) return tables.error();
    auto clear = probeSky(account, *tables, scene, rays);
    if (!clear) return clear.error();
    results = std::move(*clear);
  }
  Progress progress("probe", options.quiet);
  std::unique_ptr<Stage> stage;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const ProbeDirections d = directionsOf(rays[i]);
    if (!stage || d.toSun != scene.sun->direction_planet) {
      scene.sun->direction_planet = d.toSun;
      stage.reset();
      auto opened = openStage(scene, settings, options.gpu);
      if (!opened) return opened.error();
      stage = std::make_unique<Stage>(std::move(*opened));
    }
    const auto drawn = drawConverged(*stage->renderer, pixelView(scene, rays[i], d), {});
    if (!drawn) return drawn.error();
    const ImageF pixel = stage->renderer->radiance();
    for (std::size_t c = 0; c < 3; ++c) {
      results[i].radiance[c] = pixel.rgba[c];
      results[i].transmittance[c] *= 1 - pixel.rgba[3];
    }
    progress.update(double(i + 1) / double(rays.size()));
  }
  return results;
}

}  // namespace welkin::app
