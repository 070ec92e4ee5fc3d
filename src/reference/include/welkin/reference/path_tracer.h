#pragma once
// All orders of scattering by Monte Carlo: light paths from the observer backwards through the shell.
#include <cstdint>
#include <memory>

#include "welkin/reference/cells.h"

namespace welkin::reference {

// What lights the shell: the sun; or, for a test with a known answer, a radiance of 1 from every direction outside.
enum class Light { Sun, Everywhere };

struct PathSettings {
  int maxOrders = 0;                   // events at most, 0: any number
  double relativeError = 0.003;        // stop when each standard error is at most this share of the radiance
  std::uint64_t maxPaths = 4'000'000;  // or after this many paths, rounded up to whole rounds
  std::uint64_t seed = 1;              // two seeds: two independent estimates
  unsigned threads = 1;                // 0: one a core; the estimate does not depend on it
  bool withFirstOrder = false;         // false: only light of two events or more
  Light light = Light::Sun;
};

struct Estimate {
  Spectrum mean{}, standardError{};  // of batches
  std::uint64_t paths = 0;
};

class Guide;

// Each path is one ray of events. An event (air or ground) is drawn from a table of the segment's cells and weighted by transmittance
// over the density it was drawn with, so that no path is lost to space and none is biased; at each event the sun is seen through the
// air in its way; the next direction comes from the phase functions there. All three wavelengths share a path, weighted by the mean of the
// densities that each would have drawn it with (balance heuristic; Wilkie et al. 2014). Paths end by Russian roulette on
// the light still expected.
class PathTracer {
 public:
  explicit PathTracer(const Medium& medium);  // keeps a reference
  ~PathTracer();

  // `known`: radiance besides the estimate, so that the relative error is that of the sum.
  Estimate estimate(const LitRay& ray, const PathSettings& settings, const Spectrum& known = Spectrum(0)) const;

 private:
  const Medium& medium_;
  std::vector<double> altitudes_m_;
  std::unique_ptr<Guide> guide_;
};

}  // namespace welkin::reference
