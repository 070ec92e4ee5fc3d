#pragma once
// The truth along one ray: what other methods are measured against.
#include <cstdint>

#include "welkin/physics/probe.h"
#include "welkin/reference/medium.h"

namespace welkin::reference {

// Radiance of light that met the air or the ground at most once. No standard error: it is computed, not drawn.
ProbeResult singleOrderRadiance(const Medium& medium, const ProbeRay& ray);

}  // namespace welkin::reference
