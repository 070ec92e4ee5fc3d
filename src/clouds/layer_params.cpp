#include "welkin/clouds/layer_params.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "welkin/shared/noise.glsl.h"

namespace welkin {
namespace {

// Height over which a voxel of this size averages a layer's profile. A layer much thinner than a voxel, averaged over one voxel, beats
// with the lattice: stripes over the disc. Over two voxels the beat is gone to the eye; voxels that resolve the layers keep their sharpness.
double averaged_m(double voxel_m) {
  constexpr double kSharp_m = 500, kThin_m = 4000;  // thinner than any layer; thicker than most
  const double share = std::clamp(std::log(voxel_m / kSharp_m) / std::log(kThin_m / kSharp_m), 0.0, 1.0);
  return voxel_m * (1 + share);
}

// From this voxel on the mean is averaged once more, over a voxel. Two voxels alone leave beats along the diagonals of the lattice, where
// its planes are closer: 6 % of the optical depth along (1, 1, 0), 9 % along (1, 1, 1) (sinc of 2 / spacing); both together 1 %.
constexpr double kBlurFrom_m = 2000;

// A profile needs some fade to be integrable and continuous; a metre is below any voxel that is drawn.
constexpr double kLeastFade_m = 1;
// Below this part of the fade the profile's mean over a voxel differs from its value at the point by less than 1/160 at a kink.
constexpr double kPointPart = 0.05;
// How fast clumps get resolved with the share of the noise's variance that is shown: fitted so that transmittance is the same on all
// levels (tests/unit/clouds/layers_test.cpp prints it); half of it, or double, is visibly worse.
constexpr double kClumpPower = 0.35;

std::uint32_t shiftOf(double cell_m, const RootFrame& root) {
  return static_cast<std::uint32_t>(std::clamp(std::lround(std::log2(cell_m * root.stepsPerMetre())), 2l, 30l));
}

// Variance of one octave of amplitude 1: the plain and the billow part are uncorrelated (one odd, one even in the noise).
double octaveVariance(double billow) {
  const double plain = (1 - billow) * double{shared::kNoiseSigma};
  const double lumps = billow * double{shared::kBillowScale} * double{shared::kNoiseAbsSigma};
  return plain * plain + lumps * lumps;
}

// Noise values that are exceeded with probability i / 16: quantiles of a fixed sample.
void fillThresholds(shared::CloudLayerParams& out, std::uint32_t octaves) {
  constexpr std::uint32_t kSamples = 8192;  // standard error of a quantile: at most 0.0055 in probability
  std::vector<float> values(kSamples);
  for (std::uint32_t i = 0; i < kSamples; ++i) {
    const auto bits = [&](std::uint32_t axis) { return shared::mixBits(shared::mixBits(i * 3 + axis) + out.seed); };
    values[i] = layerNoise(out, {bits(0), bits(1), bits(2)}, octaves);
  }
  std::sort(values.begin(), values.end());
  for (std::uint32_t i = 0; i <= shared::kThresholdSteps; ++i) {
    const double exceed = std::clamp(static_cast<double>(i) / shared::kThresholdSteps, 0.001, 0.999);
    out.threshold[i] = values[static_cast<std::size_t>((1 - exceed) * (kSamples - 1))];
  }
  // full cover is solid: the ramp is at its end everywhere but in the taper's upper half
  out.threshold[shared::kThresholdSteps] -= 1 / out.invSoftness + 0.5f * out.taper + 0.01f;  // and rounding
}

// Optical depth t of a clump for clumping(): of sample columns under half cover, mean depth and mean transmittance give the factor
// 1 / (1 + t / 2) that turns one into the other.
double clumpDepth(const shared::CloudLayerParams& layer, const RootFrame& root, std::uint32_t octaves) {
  constexpr std::uint32_t kColumns = 256, kHeights = 16;
  const float threshold = layer.threshold[shared::kThresholdSteps / 2];
  const double dz_m = static_cast<double>(layer.thickness_m) / kHeights;
  double depth = 0, transmittance = 0;
  for (std::uint32_t i = 0; i < kColumns; ++i) {
    const auto bits = [&](std::uint32_t axis) { return shared::mixBits(shared::mixBits(i * 3 + axis + 77777) + layer.seed); };
    glm::uvec3 p(bits(0), bits(1), bits(2));
    double sum = 0;
    for (std::uint32_t k = 0; k < kHeights; ++k) {
      const float z = (static_cast<float>(k) + 0.5f) * static_cast<float>(dz_m);
      // up is along x: a streaked layer is as deep there as it is wide
      const glm::uvec3 q(p.x + static_cast<std::uint32_t>(static_cast<double>(z) * root.stepsPerMetre()), p.y, p.z);
      const float x = (layerNoise(layer, q, octaves) - threshold - layer.taper * z * layer.invThickness) * layer.invSoftness;
      const float profile = std::min(std::min(z * layer.invBaseFade, (layer.thickness_m - z) * layer.invTopFade), 1.0f);
      sum += static_cast<double>(std::clamp(x, 0.0f, 1.0f) * profile * layer.extinction_per_m) * dz_m;
    }
    depth += sum / kColumns;
    transmittance += std::exp(-sum) / kColumns;
  }
  return depth > 1e-6 ? std::max(0.0, 2 * (depth / -std::log(transmittance) - 1)) : 0;
}

}  // namespace

float layerNoise(const shared::CloudLayerParams& layer, glm::uvec3 p, std::uint32_t octaves) {
  float n = 0, amplitude = layer.amplitude;
  for (std::uint32_t k = 0; k < octaves; ++k) {
    const std::uint32_t s = layer.shift - k;
    n += amplitude * shared::billowNoise(shared::noise3(p, s, s - layer.streak, shared::octaveSeed(layer.seed, k)), layer.billow);
    amplitude *= layer.gain;
  }
  return n;
}

shared::CloudLayerParams makeLayerParams(const CloudLayer& layer, const RootFrame& root, std::uint32_t seed) {
  shared::CloudLayerParams out{};
  const double thickness = std::max(layer.top_m - layer.base_m, 2 * kLeastFade_m);
  const double baseFade = std::clamp(layer.baseFade_m, kLeastFade_m, thickness - kLeastFade_m);
  const double topFade = std::clamp(layer.topFade_m, kLeastFade_m, thickness - baseFade);
  out.base_m = static_cast<float>(layer.base_m);
  out.thickness_m = static_cast<float>(thickness);
  out.invThickness = static_cast<float>(1 / thickness);
  out.baseFade_m = static_cast<float>(baseFade);
  out.invBaseFade = static_cast<float>(1 / baseFade);
  out.topFade_m = static_cast<float>(topFade);
  out.invTopFade = static_cast<float>(1 / topFade);
  out.extinction_per_m = static_cast<float>(layer.extinction_per_m);
  out.coverGain = static_cast<float>(layer.coverGain);
  out.coverBias = static_cast<float>(layer.coverBias);

  out.typed = layer.typeLow < layer.typeHigh ? 1 : 0;
  if (out.typed) {
    // fades over a quarter of the range inside it; no fade where the range reaches the end of the field
    const float inv = static_cast<float>(4 / (layer.typeHigh - layer.typeLow));
    const bool low = layer.typeLow <= 0, high = layer.typeHigh >= 1;
    out.typeLow = low ? -1.0f : static_cast<float>(layer.typeLow);
    out.typeHigh = high ? 2.0f : static_cast<float>(layer.typeHigh);
    out.typeInvRiseLow = low ? 1.0f : inv;
    out.typeInvRiseHigh = high ? 1.0f : inv;
  }

  out.seed = seed;
  out.shift = shiftOf(layer.cell_m, root);
  out.streak = static_cast<std::uint32_t>(std::clamp(layer.streak, 0, static_cast<int>(out.shift) - 2));
  const auto octaves = static_cast<std::uint32_t>(std::clamp(layer.octaves, 0, static_cast<int>(out.shift - out.streak) - 1));
  double sum = 0;
  for (std::uint32_t k = 0; k < octaves; ++k) sum += std::pow(layer.gain, k);
  const double amplitude = sum > 0 ? 1 / sum : 0;
  out.amplitude = static_cast<float>(amplitude);
  out.gain = static_cast<float>(layer.gain);
  out.billow = static_cast<float>(std::clamp(layer.billow, 0.0, 1.0));
  out.restHigh =
      static_cast<float>(1 + double{out.billow} * (double{shared::kBillowScale} * (1 - double{shared::kNoiseAbsMean}) - 1) + 1e-3);
  out.invSoftness = static_cast<float>(1 / std::max(layer.softness, 1e-3));
  out.taper = static_cast<float>(layer.taper);
  out.topFollowsCover = static_cast<float>(std::clamp(layer.topFollowsCover, 0.0, 0.95));
  // A warp is four times as wide as it reaches: steeper ones would fold. It stays inside the root cube's margin.
  const double warp_m = std::min(layer.warp_m, 0.0009 * root.planetRadius_m);
  out.warp_steps = static_cast<float>(warp_m * root.stepsPerMetre());
  out.warpShift = shiftOf(std::max(4 * warp_m, 1.0), root);
  fillThresholds(out, octaves);

  double variance = 0;
  for (std::uint32_t k = 0; k < octaves; ++k)
    variance += std::pow(amplitude * std::pow(layer.gain, k), 2) * octaveVariance(double{out.billow});
  const double depth = octaves > 0 ? clumpDepth(out, root, octaves) : 0;

  for (std::uint32_t level = 0; level <= shared::kMaxDepth; ++level) {
    // The least cell that samples a voxel apart show is 1.75 voxels = 2^(30 - level) steps.
    const std::uint32_t leastShift = level >= 28 ? 2 : 30 - level;
    std::uint32_t shown = 0;
    while (shown < octaves && out.shift - shown - out.streak >= leastShift) ++shown;
    double dropped = 0, amplitudeShown = 0;
    for (std::uint32_t k = 0; k < octaves; ++k) {
      const double a = amplitude * std::pow(layer.gain, k);
      if (k < shown)
        amplitudeShown += a;
      else
        dropped += a * a * octaveVariance(double{out.billow});
    }
    const double voxel_m = root.nodeSize_m(level) / shared::kBrickCells;
    // Over its height a voxel also sees the taper change: a uniform distribution, variance (range^2) / 12.
    const double taperRange = layer.taper * std::min(voxel_m, thickness) / thickness;
    const double sigma = std::sqrt(dropped + taperRange * taperRange / 12);
    const double spread = std::sqrt(6.0) * sigma * double{out.invSoftness};  // triangle of half width a: variance a^2 / 6
    out.octaves[level] = shown;
    out.shown[level] = static_cast<float>(amplitudeShown);
    out.spread[level] = static_cast<float>(spread);
    out.invSpread2[level] = spread > 1e-4 ? static_cast<float>(1 / (6 * spread * spread)) : 0;  // below, the cubic is under 2e-5
    const double clump = variance > 0 ? depth * std::pow(dropped / variance, kClumpPower) : 0;
    out.clump[level] = clump > 1e-3 ? static_cast<float>(clump) : 0;
    const bool point = voxel_m < kPointPart * std::min(baseFade, topFade);
    out.filter_m[level] = point ? 0 : static_cast<float>(averaged_m(voxel_m));
    out.blur_m[level] = point || voxel_m < kBlurFrom_m ? 0 : static_cast<float>(voxel_m);
  }
  return out;
}

shared::CloudHeader makeCloudHeader(const RootFrame& root, std::uint32_t seed, std::uint32_t layerCount) {
  shared::CloudHeader out{};
  out.layerCount = layerCount;
  out.typeShift = 28;  // a sixteenth of the root cube: 800 km on an Earth, about the size of an air mass
  out.seed = shared::mixBits(seed ^ 0x51ED270Bu);
  out.step_m = static_cast<float>(root.step_m());
  const double radius = root.planetRadius_m * root.stepsPerMetre();
  out.radius_steps = static_cast<float>(radius);
  const auto bits = std::bit_cast<std::uint64_t>(radius * radius);
  out.radius2Low = static_cast<std::uint32_t>(bits);
  out.radius2High = static_cast<std::uint32_t>(bits >> 32);
  for (std::uint32_t level = 0; level <= shared::kMaxDepth; ++level)
    out.footprint_m[level] = static_cast<float>(root.nodeSize_m(level) / shared::kBrickCells);
  return out;
}

}  // namespace welkin
