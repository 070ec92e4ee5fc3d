#pragma once
// Rays of `welkin probe` through a scene with clouds: each is a picture of one pixel.
#include <vector>

#include "welkin/app/options.h"
#include "welkin/core/progress.h"
#include "welkin/physics/probe.h"
#include "welkin/reference/path_tracer.h"

namespace welkin::app {

// A probe's ray in the planet frame.
struct ProbeDirections {
  glm::dvec3 up, toSun, view;  // unit
};
ProbeDirections directionsOf(const ProbeRay& ray);

// All orders by paths through the density source itself, band-limited to voxels of the scene's depth (reference/cloud_path_tracer.h);
// transmittance of air and cloud by quadrature. Fails in one line: clouds that reach beyond the air, data that is missing.
Result<std::vector<ProbeResult>> probeCloudsReference(const Scene& scene, const std::vector<ProbeRay>& rays,
                                                      const reference::PathSettings& paths, bool quiet);

// The scene is drawn converged for each ray, with a point sun of irradiance 1 that stands in the south of the observer (over the north
// pole: above longitude 0); rays one after the other under the same sun share a start. Transmittance is of air and cloud. Fails in one
// line: a ray that ends at a distance (clouds are not cut), memory, no OpenGL.
Result<std::vector<ProbeResult>> probeClouds(Scene scene, const std::vector<ProbeRay>& rays, const CommonOptions& options);

}  // namespace welkin::app
