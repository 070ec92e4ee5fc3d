#include "welkin/reference/cloud_path_tracer.h"

#include <algorithm>
#include <cmath>

#include "cloud_path.h"
#include "welkin/reference/parallel.h"

namespace welkin::reference {
namespace {

constexpr std::uint64_t kBatchPaths = 3 * 32;  // each wavelength draws a third
constexpr std::uint64_t kRoundBatches = 24;    // between looks at the error
constexpr std::uint64_t kDarkBatches = 240;    // before nothing seen is taken for darkness: sunlight under thick cloud is rare
constexpr double kDarkness = 1e-12;            // as the clear air's path tracer has it
constexpr double kLeakVoxels = 2.5;            // beyond the source's altitudes, by its band limit

}  // namespace

double phase(const Droplets& d, double c) {
  return (1 - d.forwardShare) * henyeyGreenstein(c, d.backwardG) + d.forwardShare * henyeyGreenstein(c, d.forwardG);
}

Result<Medium> mediumAround(const Scene& scene, const DensitySource& source) {
  if (scene.atmosphere) {
    auto medium = makeMedium(scene);
    if (medium && medium->top_m < source.top_m()) return Error{"the reference wants clouds that are within the atmosphere"};
    return medium;
  }
  Medium bare;
  bare.radius_m = scene.planet.radius_m;
  bare.top_m = source.top_m() + 1000;
  bare.albedo = spectrum(scene.planet.albedo);
  bare.sunRadius_rad = scene.sun ? scene.sun->angularRadius_rad : Sun{}.angularRadius_rad;
  return bare;
}

CloudPathTracer::CloudPathTracer(const Medium& air, const DensitySource& source, const RootFrame& root, const DetailRule& detail,
                                 const Droplets& droplets)
    : air_(air), source_(source), root_(root), detail_(detail), droplets_(droplets), cells_m_(cellAltitudes(air)) {
  const double leak = kLeakVoxels / 7 * root.nodeSize_m(detail.depth);
  base_m_ = source.base_m() - leak;
  top_m_ = std::min({source.top_m() + leak, air.top_m, root.half_m - root.planetRadius_m});
  altitudes_m_ = cells_m_;
  for (const double h : {0.0, base_m_, top_m_, air.top_m}) altitudes_m_.push_back(h);
  std::erase_if(altitudes_m_, [&](double h) { return h < 0 || h > air.top_m; });
  std::sort(altitudes_m_.begin(), altitudes_m_.end());
  altitudes_m_.erase(std::unique(altitudes_m_.begin(), altitudes_m_.end()), altitudes_m_.end());
  for (std::size_t i = 0; i + 1 < altitudes_m_.size(); ++i) {
    // Profiles have their corners among the borders: between them each is greatest at one end.
    const double from = altitudes_m_[i], to = altitudes_m_[i + 1];
    Spectrum sum{};
    for (const MediumLayer& layer : air.layers) sum += layer.extinction * std::max(density(layer, from), density(layer, to));
    slabs_.push_back({from, to, std::max({sum.x, sum.y, sum.z}), from < top_m_ && to > base_m_});
  }
}

Estimate CloudPathTracer::estimate(const PathRay& ray, const PathSettings& settings) const {
  Spectrum sum{}, squares{};
  std::uint64_t batches = 0;
  Estimate out;
  while (out.paths < settings.maxPaths) {
    std::vector<Spectrum> means(kRoundBatches);
    forEach(kRoundBatches, settings.threads, [&](std::size_t b) {
      Random random(mixSeeds(settings.seed, batches + b));
      const PathNumbers::Shift shift(random);
      CloudPath path(*this, ray, settings);
      Spectrum batch{};
      for (std::uint64_t i = 0; i < kBatchPaths; ++i) {
        PathNumbers numbers(shift, i / 3, random);
        batch += path.draw(int(i % 3), numbers);
      }
      means[b] = batch / double(kBatchPaths);
    });
    for (const Spectrum& m : means) sum += m, squares += m * m;
    batches += kRoundBatches;
    out.paths += kRoundBatches * kBatchPaths;
    const double n = double(batches);
    out.mean = sum / n;
    out.standardError = glm::sqrt(glm::max(squares / n - out.mean * out.mean, Spectrum(0)) / (n - 1));
    if (out.mean == Spectrum(0) && batches < kDarkBatches) continue;
    if (glm::all(glm::lessThanEqual(out.standardError, glm::max(settings.relativeError * out.mean, Spectrum(kDarkness))))) break;
  }
  return out;
}

}  // namespace welkin::reference
