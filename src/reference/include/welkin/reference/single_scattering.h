#pragma once
// Light that met the air or the ground once on its way from the sun to the observer.
#include "welkin/reference/shell_ray.h"

namespace welkin::reference {

struct SingleScattering {
  Spectrum radiance{}, transmittance{};
  bool converged = true;  // the integral along the ray kept its tolerance within 2,000 panels
};

// L = int T(0, t) T_sun(t) sum over layers of (scattering * phase) dt + T(0, end) albedo / pi * E_sun(end) where the ray ends on the
// ground; for a solar irradiance of 1, in 1/sr. To 1e-7 relative (or 1e-30: of the sun's light less than a photon a year through a
// pupil). The sun's whole light comes from its centre as far as the phase functions are concerned.
SingleScattering singleScattering(const Medium& medium, const LitRay& ray);

}  // namespace welkin::reference
