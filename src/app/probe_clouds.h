#pragma once
// Rays of `welkin probe` through a scene with clouds: each is a picture of one pixel.
#include <vector>

#include "welkin/app/options.h"
#include "welkin/core/progress.h"
#include "welkin/physics/probe.h"

namespace welkin::app {

// The scene is drawn converged for each ray, with a point sun of irradiance 1 that stands in the south of the observer (over the north
// pole: above longitude 0); rays one after the other under the same sun share a start. Transmittance is of air and cloud. Fails in one line: a ray that
// ends at a distance (clouds are not cut), memory, no OpenGL.
Result<std::vector<ProbeResult>> probeClouds(Scene scene, const std::vector<ProbeRay>& rays, const CommonOptions& options);

}  // namespace welkin::app
