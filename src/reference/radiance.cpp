#include "welkin/reference/radiance.h"

#include "welkin/reference/single_scattering.h"

namespace welkin::reference {

ProbeResult singleOrderRadiance(const Medium& medium, const ProbeRay& ray) {
  const auto lit = enterShell(medium, ray);
  if (!lit) return {};
  const SingleScattering once = singleScattering(medium, *lit);
  return {spectrum3(once.radiance), spectrum3(once.transmittance), {}};
}

ProbeResult radiance(const Medium& medium, const PathTracer& tracer, const ProbeRay& ray, const PathSettings& settings) {
  const auto lit = enterShell(medium, ray);
  if (!lit) return {};
  const SingleScattering once = singleScattering(medium, *lit);
  const Estimate further = tracer.estimate(*lit, settings, once.radiance);
  return {spectrum3(once.radiance + further.mean), spectrum3(once.transmittance), spectrum3(further.standardError)};
}

}  // namespace welkin::reference
