#include "welkin/reference/radiance.h"

#include "welkin/reference/single_scattering.h"

namespace welkin::reference {

ProbeResult singleOrderRadiance(const Medium& medium, const ProbeRay& ray) {
  const auto lit = enterShell(medium, ray);
  if (!lit) return {};
  const SingleScattering once = singleScattering(medium, *lit);
  return {spectrum3(once.radiance), spectrum3(once.transmittance), {}};
}

}  // namespace welkin::reference
