#include "welkin/clouds/layers_source.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "welkin/clouds/layer_params.h"
#include "welkin/clouds/noise_bounds.h"
#include "welkin/shared/cloud_layers.glsl.h"

namespace welkin {
namespace {

// Altitudes from floats are off by at most 0.03 m (cloudAltitude), from the doubles here by far less.
constexpr double kAltitudeSlack_m = 0.05;

float lowAmplitude(float billow) { return -billowInterval({-1, 1}, billow).lo; }

}  // namespace

struct LayeredClouds::Box {
  glm::uvec3 corner;
  std::uint32_t level;
  float altitudeLo_m, altitudeHi_m;  // of |altitude|
  Interval cover, type;
};

LayeredClouds::LayeredClouds(const std::vector<CloudLayer>& layers, std::optional<CoverMap> cover, const RootFrame& root,
                             std::uint32_t seed, std::string note)
    : root_(root), cover_(std::move(cover)), note_(std::move(note)) {
  const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(layers.size(), shared::kMaxCloudLayers));
  block_.header = makeCloudHeader(root, seed, count);
  block_.header.lowest_m = block_.header.highest_m = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    auto& layer = block_.layers[i] = makeLayerParams(layers[i], root, shared::mixBits(seed * 977 + i * 131 + 7));
    const float top = layer.base_m + layer.thickness_m;
    block_.header.lowest_m = i == 0 ? layer.base_m : std::min(block_.header.lowest_m, layer.base_m);
    block_.header.highest_m = i == 0 ? top : std::max(block_.header.highest_m, top);
    slackHigh_.resize((i + 1) * (shared::kMaxDepth + 1));
    slackLow_.resize(slackHigh_.size());
    float high = 0, low = 0;
    for (std::uint32_t level = shared::kMaxDepth + 1; level-- > 0;) {
      const float dropped = layer.amplitude > 0 ? 1 - layer.shown[level] : 0;
      const float spread = layer.spread[level] / layer.invSoftness;
      high = std::max(high, spread - dropped * layer.restHigh);
      low = std::max(low, spread - dropped * lowAmplitude(layer.billow));
      slackHigh_[i * (shared::kMaxDepth + 1) + level] = high + 1e-4f;  // rounding of sums of up to 30 octaves
      slackLow_[i * (shared::kMaxDepth + 1) + level] = low + 1e-4f;
    }
  }
  if (cover_) cover_->describe(block_.header);
}

std::unique_ptr<DensitySource> LayeredClouds::slab(const SlabSource& slab, const RootFrame& root) {
  CloudLayer layer;
  layer.name = "slab";
  layer.base_m = slab.base_m, layer.top_m = slab.top_m;
  layer.baseFade_m = layer.topFade_m = 0;
  layer.extinction_per_m = slab.extinction_per_m;
  layer.coverGain = 0, layer.coverBias = 1;
  layer.octaves = 0, layer.taper = 0;
  return std::make_unique<LayeredClouds>(std::vector{layer}, std::nullopt, root, 0, std::string{});
}

shared::SourceView LayeredClouds::view() const { return {&block_, cover_ ? cover_->words().data() : nullptr}; }

float LayeredClouds::density(glm::uvec3 p, std::uint32_t level) const { return shared::layersDensity(view(), p, level); }

float LayeredClouds::maxExtinction() const {
  float greatest = 0;
  for (std::uint32_t i = 0; i < block_.header.layerCount; ++i) greatest = std::max(greatest, block_.layers[i].extinction_per_m);
  return greatest;
}

// Two samples a texel of the cover, and the largest lumps of every layer are shown; the finer noise is in the stored expectation.
std::uint32_t LayeredClouds::emptyFrom() const {
  if (!cover_) return shared::kMaxDepth + 1;
  const double texel_m = root_.planetRadius_m * std::numbers::pi / 2 / block_.header.coverEdge[0];
  const auto shown = [&](std::uint32_t level) {
    for (std::uint32_t i = 0; i < block_.header.layerCount; ++i)
      if (block_.layers[i].octaves[shared::kMaxDepth] > 0 && block_.layers[i].octaves[level] == 0) return false;
    return 2 * double{block_.header.footprint_m[level]} <= texel_m;
  };
  std::uint32_t level = 0;
  while (level <= shared::kMaxDepth && !shown(level)) ++level;
  return level;
}

std::vector<std::uint32_t> LayeredClouds::shaderParams() const {
  std::vector<std::uint32_t> words(sizeof(block_) / 4);
  std::memcpy(words.data(), &block_, sizeof(block_));
  if (cover_)
    words.insert(words.end(), cover_->words().begin(), cover_->words().end());
  else
    words.push_back(0);
  return words;
}

void LayeredClouds::noiseBounds(const shared::CloudLayerParams& layer, const Box& box, float& lo, float& hi) const {
  const std::uint32_t sizeShift = 32 - box.level;
  const std::uint32_t octaves = layer.octaves[shared::kMaxDepth];
  // Warped layers: the box's middle, and how far the warp may carry its corners (three axes, Lipschitz constant of the warp).
  const bool warped = layer.warp_steps > 0;
  glm::uvec3 middle{};
  float reach_steps = 0;
  if (warped && sizeShift < 32) {
    const std::uint32_t half = sizeShift > 0 ? 1u << (sizeShift - 1) : 0;
    middle = shared::warpedPosition({&block_, nullptr}, static_cast<std::uint32_t>(&layer - block_.layers), box.corner + half);
    const float h = std::ldexp(0.5f, static_cast<int>(sizeShift));
    reach_steps =
        h + layer.warp_steps * std::min(2.0f, 3 * shared::kNoiseLipschitz * std::ldexp(h, -static_cast<int>(layer.warpShift))) + 2;
  }
  lo = hi = 0;
  float amplitude = layer.amplitude, rest = 1;
  for (std::uint32_t k = 0; k < octaves; ++k, rest -= amplitude, amplitude *= layer.gain) {
    const std::uint32_t s = layer.shift - k, z = s - layer.streak, seed = shared::octaveSeed(layer.seed, k);
    Interval n{-1, 1};
    if (!warped) {
      if (sizeShift <= z) n = noiseInterval(box.corner, sizeShift, s, z, seed);
    } else if (sizeShift < 32) {
      const float slope = std::ldexp(2.0f, -static_cast<int>(s)) + std::ldexp(1.0f, -static_cast<int>(z));
      const float reach = shared::kNoiseLipschitz * reach_steps * slope;
      if (reach < 1) {
        const float v = shared::noise3(middle, s, z, seed);
        n = {std::max(-1.0f, v - reach), std::min(1.0f, v + reach)};
      }
    }
    if (n.lo <= -1 && n.hi >= 1) {  // this octave and all finer ones: the whole range
      rest = std::max(rest, 0.0f);
      lo -= rest * lowAmplitude(layer.billow);
      hi += rest * layer.restHigh;
      return;
    }
    n = billowInterval(n, layer.billow);
    lo += amplitude * n.lo;
    hi += amplitude * n.hi;
  }
}

Bounds LayeredClouds::layerBounds(std::uint32_t index, const Box& box) const {
  const auto& layer = block_.layers[index];
  const auto view = this->view();
  const shared::LayerAt layerNow = shared::layerAt(view, index, box.level);
  const float reach = 0.5f * (layer.filter_m[box.level] + layer.blur_m[box.level]);
  const float low = box.altitudeLo_m - reach - layer.base_m, high = box.altitudeHi_m + reach - layer.base_m;
  if (high <= 0 || low >= layer.thickness_m) return {};
  float weightLo = 1, weightHi = 1;
  if (layer.typed) {
    const float a = shared::typeWeight(view, index, box.type.lo), b = shared::typeWeight(view, index, box.type.hi);
    weightLo = std::min(a, b);  // a trapezoid: least at an end
    const float riseEnd = layer.typeLow + 1 / layer.typeInvRiseLow, fallStart = layer.typeHigh - 1 / layer.typeInvRiseHigh;
    weightHi = box.type.lo <= fallStart && box.type.hi >= riseEnd ? 1 : std::max(a, b);
  }
  const auto covered = [&](float cover) { return std::clamp(cover * layer.coverGain + layer.coverBias, 0.0f, 1.0f); };
  const float c0 = covered(box.cover.lo), c1 = covered(box.cover.hi);
  const float coverLo = std::min(c0, c1) * weightLo, coverHi = std::min(1.0f, std::max(c0, c1) * weightHi);
  if (coverHi <= 0) return {};

  const float scaleLo = shared::heightScale(layer.topFollowsCover, coverHi), scaleHi = shared::heightScale(layer.topFollowsCover, coverLo);
  const float z0 = low * (low > 0 ? scaleLo : scaleHi), z1 = high * scaleHi;
  if (z0 >= layer.thickness_m) return {};
  const float fallStart = layer.thickness_m - layer.topFade_m;
  const float profileLo = std::min(shared::profileAt(layerNow, z0), shared::profileAt(layerNow, z1));
  const float profileHi =
      z0 <= fallStart && z1 >= layer.baseFade_m ? 1 : std::max(shared::profileAt(layerNow, z0), shared::profileAt(layerNow, z1));
  const auto height = [&](float z) { return std::clamp(z * layer.invThickness, 0.0f, 1.0f); };

  float nLo, nHi;
  noiseBounds(layer, box, nLo, nHi);
  const std::uint32_t at = index * (shared::kMaxDepth + 1) + box.level;
  const float xHi = (nHi + slackHigh_[at] - shared::thresholdOf(view, index, coverHi) - layer.taper * height(z0)) * layer.invSoftness;
  if (xHi <= 0) return {};
  const float xLo = (nLo - slackLow_[at] - shared::thresholdOf(view, index, coverLo) - layer.taper * height(z1)) * layer.invSoftness;
  const float rounding = 1e-5f;  // of profile and ramp, relative to the greatest extinction
  const auto value = [&](float profile, float x, float cover) {
    return layer.extinction_per_m * profile * std::clamp(x, 0.0f, 1.0f) * shared::thinness(cover);
  };
  // clumping thins most at the box's own level; deeper ones not at all in the end
  const float clumping = shared::clumping(layer.clump[box.level], coverLo);
  Bounds bounds{value(profileLo, xLo, coverLo) * clumping, value(profileHi, xHi, coverHi)};
  if (bounds.lo < bounds.hi) {
    bounds.lo = std::max(0.0f, bounds.lo - rounding * layer.extinction_per_m);
    bounds.hi = std::min(layer.extinction_per_m, bounds.hi + rounding * layer.extinction_per_m);
  }
  return bounds;
}

Bounds LayeredClouds::bounds(glm::uvec3 corner, std::uint32_t level) const {
  // Altitudes of the box: from its nearest and farthest point to the planet's centre.
  const double size = std::ldexp(1.0, 32 - static_cast<int>(level));
  double near2 = 0, far2 = 0, nearZ = 0, farZ = 0;
  for (int i = 0; i < 3; ++i) {
    const double a = static_cast<double>(corner[i]) - 0x1p31, b = a + size;
    const double near = a > 0 ? a : b < 0 ? -b : 0, far = std::max(std::abs(a), std::abs(b));
    near2 += near * near;
    far2 += far * far;
    if (i == 2) nearZ = near, farZ = far;
  }
  const double radius = root_.planetRadius_m * root_.stepsPerMetre();
  const auto altitude = [&](double r2) { return (r2 - radius * radius) / (std::sqrt(r2) + radius) * root_.step_m(); };
  const double a = altitude(near2) - kAltitudeSlack_m, b = altitude(far2) + kAltitudeSlack_m;
  const double low = a > 0 ? a : b < 0 ? -b : 0, high = std::max(std::abs(a), std::abs(b));
  const double reach = 1.5 * double{block_.header.footprint_m[level]};  // of the profile's means: at most two voxels and one, half up, half down
  if (high + reach <= base_m() || low - reach >= top_m()) return {};

  Box box{corner, level, static_cast<float>(low), static_cast<float>(high), {1, 1}, {0, 1}};
  if (cover_) {
    const CoverRange r = cover_->range(corner, std::uint64_t{1} << (32 - level), block_.header.coverMip[level]);
    if (r.hi <= 0) return {};
    box.cover = {r.lo, r.hi};
  }
  const std::uint32_t sizeShift = 32 - level, shift = block_.header.typeShift, seed = block_.header.seed;
  const Interval n0 = noiseInterval(corner, sizeShift, shift, shift, seed);
  const Interval n1 = noiseInterval(corner, sizeShift, shift - 1, shift - 1, shared::octaveSeed(seed, 1));
  const auto sin2 = [](double z, double r2) { return static_cast<float>(std::clamp(z * z / std::max(r2, 1.0), 0.0, 1.0)); };
  const float rounding = 1e-4f;
  box.type = {shared::typeFromNoise(n0.lo, n1.lo, sin2(farZ, near2)) - rounding,
              shared::typeFromNoise(n0.hi, n1.hi, sin2(nearZ, far2)) + rounding};

  Bounds bounds;
  for (std::uint32_t i = 0; i < block_.header.layerCount; ++i) {
    const Bounds l = layerBounds(i, box);
    bounds.lo = std::max(bounds.lo, l.lo);
    bounds.hi = std::max(bounds.hi, l.hi);
  }
  return bounds;
}

}  // namespace welkin
