#pragma once
// The sun's light where it has met nothing but air: a disc of uniform radiance, or a point.
#include "welkin/reference/medium.h"

namespace welkin::reference {

// Part of the sun's irradiance that arrives at an altitude, on a surface that faces the sun. `muSun`: zenith cosine of its centre. Of a
// disc: the mean transmittance over its solid angle, with 0 for what is below the planet's edge, to 1e-8 relative (or 1e-16).
Spectrum sunTransmittance(const Medium& medium, double altitude_m, double muSun);

// The same on a horizontal surface on the ground: the mean of transmittance times zenith cosine.
Spectrum sunOnGround(const Medium& medium, double muSun);

}  // namespace welkin::reference
