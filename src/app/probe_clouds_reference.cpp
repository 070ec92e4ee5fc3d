#include "probe_clouds.h"
#include "welkin/core/log.h"
#include "welkin/reference/cloud_path_tracer.h"
#include "welkin/reference/columns.h"
#include "welkin/reference/random.h"

namespace welkin::app {

Result<std::vector<ProbeResult>> probeCloudsReference(const Scene& scene, const std::vector<ProbeRay>& rays,
                                                      const reference::PathSettings& paths, bool quiet) {
  const RootFrame root = RootFrame::enclosing(scene.planet.radius_m, kCloudShell_m);
  auto source = makeDensitySource(scene, root);
  if (!source) return source.error();
  if (!(*source)->note().empty()) log::warn("{}", (*source)->note());
  auto air = reference::mediumAround(scene, **source);
  if (!air) return air.error();
  const reference::DetailRule detail{.depth = std::uint32_t(scene.quality.depth)};
  const reference::CloudPathTracer tracer(*air, **source, root, detail);
  std::vector<ProbeResult> results(rays.size());
  Progress progress("probe", quiet);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const ProbeDirections d = directionsOf(rays[i]);
    const reference::PathRay ray{d.up * (air->radius_m + std::max(rays[i].altitude_m, 0.0)), d.view, d.toSun, rays[i].maxDistance_m};
    reference::PathSettings settings = paths;
    settings.seed = reference::mixSeeds(paths.seed, i);
    const reference::Estimate e = tracer.estimate(ray, settings);
    reference::Spectrum transmittance(1);
    if (const auto lit = reference::enterShell(*air, rays[i]))
      transmittance = glm::exp(-reference::opticalDepth(*air, lit->ray, 0, lit->length_m));
    const reference::SourceField field(**source, root, {detail, ray.position_planet, d.toSun});
    transmittance *= std::exp(-field.opticalDepth(reference::rayFrom(ray.position_planet, d.view, air->radius_m), ray.maxDistance_m));
    results[i] = {reference::spectrum3(e.mean), reference::spectrum3(transmittance), reference::spectrum3(e.standardError)};
    progress.update(double(i + 1) / double(rays.size()));
  }
  if (tracer.aboveBounds() > 0) log::warn("{} densities were above their bounds: the estimates are biased", tracer.aboveBounds());
  return results;
}

}  // namespace welkin::app
