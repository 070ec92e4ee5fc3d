#pragma once
// Optical depth along rays: the integral of extinction over distance.
#include "welkin/reference/shell_ray.h"

namespace welkin::reference {

// Of the piece [from, to] of a ray inside the shell, by adaptive Gauss-Kronrod quadrature to 1e-10 relative (or 1e-13).
Spectrum opticalDepth(const Medium& medium, const ShellRay& ray, double from_m, double to_m);

// From an altitude to the shell's top along a zenith cosine; none where the ground is in the way.
std::optional<Spectrum> opticalDepthToTop(const Medium& medium, double altitude_m, double mu);

}  // namespace welkin::reference
