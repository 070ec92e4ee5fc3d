#include "welkin/reference/columns.h"

#include "welkin/reference/quadrature.h"

namespace welkin::reference {

// An absolute error of the optical depth is a relative one of the transmittance: 1e-13 is far below what follows from the relative part.
constexpr Tolerance kColumnTolerance{1e-10, 1e-13};

Spectrum opticalDepth(const Medium& medium, const ShellRay& ray, double from_m, double to_m) {
  const auto breaks = splits(medium, ray, from_m, to_m);
  return integrate([&](double t) { return extinction(medium, ray.altitudeAt(t)); }, breaks, kColumnTolerance).value;
}

std::optional<Spectrum> opticalDepthToTop(const Medium& medium, double altitude_m, double mu) {
  const ShellRay ray = rayFrom(medium, altitude_m, mu);
  if (distanceToGround(ray)) return std::nullopt;
  return opticalDepth(medium, ray, 0, distanceToTop(ray, medium.top_m));
}

}  // namespace welkin::reference
