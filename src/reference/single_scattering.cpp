#include "welkin/reference/single_scattering.h"

#include <algorithm>
#include <numbers>

#include "welkin/reference/columns.h"
#include "welkin/reference/quadrature.h"
#include "welkin/reference/sun.h"

namespace welkin::reference {

constexpr Tolerance kScatterTolerance{1e-7, 1e-30};

SingleScattering singleScattering(const Medium& medium, const LitRay& lit) {
  const ShellRay& ray = lit.ray;
  std::vector<double> breaks = splits(medium, ray, 0, lit.length_m);
  const auto edges = terminators(medium, lit);
  breaks.insert(breaks.end(), edges.begin(), edges.end());
  std::sort(breaks.begin(), breaks.end());
  const auto source = [&](double t) {
    const double h = ray.altitudeAt(t);
    const Spectrum sun = sunTransmittance(medium, h, lit.sunMuAt(t));
    if (sun == Spectrum(0)) return sun;
    return glm::exp(-opticalDepth(medium, ray, 0, t)) * sun * scatteringTowards(medium, h, lit.cosSun);
  };
  SingleScattering out;
  const Integral scattered = integrate(source, breaks, kScatterTolerance);
  out.radiance = scattered.value, out.converged = scattered.converged;
  out.transmittance = glm::exp(-opticalDepth(medium, ray, 0, lit.length_m));
  if (lit.end == RayEnd::Ground)
    out.radiance += out.transmittance * medium.albedo / std::numbers::pi * sunOnGround(medium, lit.sunMuAt(lit.length_m));
  return out;
}

}  // namespace welkin::reference
