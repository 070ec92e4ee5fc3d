#include "welkin/reference/path_tracer.h"

#include <cmath>

#include "guide.h"
#include "path.h"
#include "welkin/reference/parallel.h"

namespace welkin::reference {
namespace {

constexpr std::uint64_t kBatchPaths = 3 * 128;  // each wavelength draws a third
constexpr std::uint64_t kRoundBatches = 24;     // between looks at the error; a standard error of 24 batches is known to 15 %

}  // namespace

PathTracer::PathTracer(const Medium& medium)
    : medium_(medium), altitudes_m_(cellAltitudes(medium)), guide_(std::make_unique<Guide>(medium, altitudes_m_)) {}
PathTracer::~PathTracer() = default;

Estimate PathTracer::estimate(const LitRay& ray, const PathSettings& settings, const Spectrum& known) const {
  Spectrum sum{}, squares{};
  std::uint64_t batches = 0;
  Estimate out;
  while (out.paths < settings.maxPaths) {
    std::vector<Spectrum> means(kRoundBatches);
    forEach(kRoundBatches, settings.threads, [&](std::size_t b) {
      Random random(mixSeeds(settings.seed, batches + b));
      const PathNumbers::Shift shift(random);
      PathDrawer drawer(medium_, altitudes_m_, *guide_, ray, settings);
      Spectrum batch{};
      for (std::uint64_t i = 0; i < kBatchPaths; ++i) {
        PathNumbers numbers(shift, i / 3, random);
        batch += drawer.draw(int(i % 3), numbers);
      }
      means[b] = batch / double(kBatchPaths);
    });
    for (const Spectrum& m : means) sum += m, squares += m * m;
    batches += kRoundBatches;
    out.paths += kRoundBatches * kBatchPaths;
    const double n = double(batches);
    out.mean = sum / n;
    out.standardError = glm::sqrt(glm::max(squares / n - out.mean * out.mean, Spectrum(0)) / (n - 1));
    if (glm::all(glm::lessThanEqual(out.standardError, settings.relativeError * (out.mean + known)))) break;
  }
  return out;
}

}  // namespace welkin::reference
