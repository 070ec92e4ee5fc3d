#pragma once
// The truth along one ray: what other methods are measured against.
#include <cstdint>

#include "welkin/physics/probe.h"
#include "welkin/reference/path_tracer.h"

namespace welkin::reference {

// Radiance of light that met the air or the ground at most once. No standard error: it is computed, not drawn.
ProbeResult singleOrderRadiance(const Medium& medium, const ProbeRay& ray);

// The same with all further orders, drawn at random, and the standard error of that: the first order is computed as above. Light of one
// event counts in the stop rule.
ProbeResult radiance(const Medium& medium, const PathTracer& tracer, const ProbeRay& ray, const PathSettings& settings);

}  // namespace welkin::reference
