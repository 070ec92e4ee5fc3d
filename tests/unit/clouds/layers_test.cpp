#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "random32.h"
#include "welkin/clouds/default_layers.h"
#include "welkin/clouds/layer_params.h"
#include "welkin/clouds/layers_source.h"
#include "welkin/clouds/sphere_source.h"
#include "welkin/shared/cloud_column.glsl.h"

namespace welkin {
namespace {

using Random = test::Random32;

const RootFrame kRoot = RootFrame::enclosing(6'371'000, 12'000);

// Full cover of value c everywhere.
LayeredClouds uniform(CloudLayer layer, double c) {
  layer.coverGain = 0;
  layer.coverBias = c;
  layer.typeLow = layer.typeHigh = 0;
  layer.topFollowsCover = 0;
  return LayeredClouds({layer}, std::nullopt, kRoot, 3, {});
}

glm::dvec3 randomDirection(Random& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

// What a brick's trilinear interpolation gives at x.
double interpolated(const DensitySource& source, glm::dvec3 x, std::uint32_t level) {
  const glm::uvec3 p = kRoot.toFixed(x), corner = shared::nodeCorner(p, level);
  const glm::vec3 local = shared::nodeLocal(p, level) * 7.0f;
  const glm::uvec3 cell = glm::min(glm::uvec3(local), glm::uvec3(6));
  const glm::vec3 f = local - glm::vec3(cell);
  double sum = 0;
  for (glm::uint k = 0; k < 8; ++k) {
    const glm::uvec3 o(k & 1, (k >> 1) & 1, k >> 2);
    const float w = (o.x ? f.x : 1 - f.x) * (o.y ? f.y : 1 - f.y) * (o.z ? f.z : 1 - f.z);
    sum += static_cast<double>(w * source.density(shared::brickSample(corner, level, cell + o), level));
  }
  return sum;
}

struct Columns {
  double depth = 0, transmittance = 0;  // means over columns
};
Columns columns(const DensitySource& source, std::uint32_t level, int count, double top_m) {
  Random random(17);
  Columns mean;
  const double voxel_m = kRoot.nodeSize_m(level) / 7;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 up = randomDirection(random);
    const double end = top_m + 2 * voxel_m, step = std::min(voxel_m / 5, top_m / 60);
    double depth = 0;
    for (double h = step / 2; h < end; h += step) depth += interpolated(source, up * (kRoot.planetRadius_m + h), level) * step;
    mean.depth += depth / count;
    mean.transmittance += std::exp(-depth) / count;
  }
  return mean;
}

TEST(Layers, AltitudeIsRightNearTheGround) {
  const LayeredClouds source = uniform(CloudLayer{}, 1);
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const double h = std::pow(10.0, static_cast<double>(random() % 1000) / 200) * (i % 2 ? 1 : -1);  // to +-100 km
    const glm::uvec3 p = kRoot.toFixed(randomDirection(random) * (kRoot.planetRadius_m + h));
    const double exact = glm::length(kRoot.toPlanet(p)) - kRoot.planetRadius_m;
    EXPECT_NEAR(static_cast<double>(shared::cloudAltitude(source.view(), p)), exact,
                std::max(0.001, 4e-7 * std::abs(exact)));  // a few float roundings
  }
}

TEST(Layers, BlockIsMadeOfWords) {
  EXPECT_EQ(sizeof(shared::CloudHeader) % 4, 0u);
  const LayeredClouds source = uniform(CloudLayer{}, 1);
  const auto words = source.shaderParams();
  ASSERT_GE(words.size(), sizeof(shared::CloudBlock) / 4);
  EXPECT_EQ(std::memcmp(words.data(), &source.block(), sizeof(shared::CloudBlock)), 0);
}

TEST(Layers, CoveredFractionIsTheCover) {
  for (const CloudLayer& layer : defaultEarthLayers()) {
    CloudLayer flat = layer;
    flat.taper = 0;
    for (const double c : {0.15, 0.3, 0.5, 0.7, 0.85}) {
      const LayeredClouds source = uniform(flat, c);
      Random random(2);
      int covered = 0;
      constexpr int kSamples = 4000;
      for (int i = 0; i < kSamples; ++i) {
        const double h = 0.5 * (flat.base_m + flat.baseFade_m + flat.top_m - flat.topFade_m);
        covered += source.density(kRoot.toFixed(randomDirection(random) * (kRoot.planetRadius_m + h)), 20) > 0;
      }
      // four standard errors of the count 0.032, the table's own sample 0.02, its linear interpolation 0.01
      EXPECT_NEAR(static_cast<double>(covered) / kSamples, c, 0.06) << layer.name << " cover " << c;
    }
  }
}

TEST(Layers, NoCoverIsEmptyAndFullCoverIsSolid) {
  for (const CloudLayer& layer : defaultEarthLayers()) {
    const LayeredClouds none = uniform(layer, 0), full = uniform(layer, 1);
    Random random(3);
    int solid = 0;
    for (int i = 0; i < 2000; ++i) {
      const double h = layer.base_m + layer.baseFade_m + 0.1 * (layer.top_m - layer.base_m - layer.baseFade_m - layer.topFade_m);
      const glm::uvec3 p = kRoot.toFixed(randomDirection(random) * (kRoot.planetRadius_m + h));
      EXPECT_EQ(none.density(p, 8 + random() % 12), 0.0f);
      solid += full.density(p, 20) > 0.99f * full.maxExtinction();
    }
    EXPECT_GT(solid, 1960) << layer.name;
  }
}

TEST(Layers, VerticalOpticalDepthOfAnOvercastSurvivesOnEveryLevel) {
  // Ground-hugging, low and high overcast: coarse voxels are 60 times as thick as the layer, and half of them lie below the ground.
  for (const auto& [base, top, fade] : {std::array{0.0, 400.0, 100.0}, {650.0, 1350.0, 120.0}, {8200.0, 10200.0, 800.0}}) {
    CloudLayer layer;
    layer.base_m = base, layer.top_m = top, layer.baseFade_m = layer.topFade_m = fade;
    layer.extinction_per_m = 0.01, layer.taper = 0;
    const LayeredClouds source = uniform(layer, 1);
    const double exact = 0.01 * (top - base - fade);
    for (std::uint32_t level = 6; level <= 14; ++level) {
      const Columns mean = columns(source, level, 300, top);
      // lattice planes cross columns at random: single columns scatter by up to 40 % where the voxel is thicker than the layer, so the mean
      // of 300 has a standard error of 2.3 %; three of them
      EXPECT_NEAR(mean.depth / exact, 1, 0.07) << "base " << base << " level " << level;
    }
  }
}

TEST(Layers, BrokenCloudLetsThroughTheSameLightOnEveryLevel) {
  for (const CloudLayer& layer : defaultEarthLayers()) {
    for (const double c : {0.25, 0.6}) {
      const LayeredClouds source = uniform(layer, c);
      const Columns truth = columns(source, 15, 400, layer.top_m);
      for (const std::uint32_t level : {7u, 9u, 10u, 12u}) {
        const Columns mean = columns(source, level, 200, layer.top_m);
        // A model of unresolved clumps, not an identity. It is worst, 0.22, where a level shows just one octave of heaps; the means'
        // standard errors are 0.02 and 0.03. Without it transmittance at level 8 is 0.0 to 0.1 instead of 0.5 for low cloud.
        EXPECT_NEAR(mean.transmittance, truth.transmittance, 0.25) << layer.name << " cover " << c << " level " << level;
        std::printf("%-15s cover %.2f level %2u: T %.3f (%.3f) depth %.2f (%.2f)\n", layer.name.c_str(), c, level, mean.transmittance,
                    truth.transmittance, mean.depth, truth.depth);
      }
    }
  }
}

TEST(Layers, ColumnsAreTheirPoints) {
  for (const CloudLayer& layer : defaultEarthLayers()) {
    const LayeredClouds source = uniform(layer, 0.6);
    Random random(4);
    int cloudy = 0;
    for (int i = 0; i < 600; ++i) {
      const std::uint32_t level = 5 + random() % 14;
      const double h = layer.base_m + (layer.top_m - layer.base_m) * static_cast<double>(random() % 1000) / 1000;
      const glm::uvec3 corner = shared::nodeCorner(kRoot.toFixed(randomDirection(random) * (kRoot.planetRadius_m + h)), level);
      const glm::uvec3 first(random() % 8, random() % 8, 0), p = shared::brickSample(corner, level, first);
      shared::Column8 steps{}, height{}, cover{}, type{}, none{};
      glm::uvec3 q[8];
      for (std::uint32_t k = 0; k < 8; ++k) {
        q[k] = shared::brickSample(corner, level, first + glm::uvec3(0, 0, k));
        steps.v[k] = static_cast<float>(q[k].z - p.z);
        height.v[k] = std::abs(shared::cloudAltitude(source.view(), q[k]));
        cover.v[k] = 1, type.v[k] = 0.5f;
      }
      const shared::Column8 column = shared::layerColumn(source.view(), none, 0, p, level, steps, height, cover, type);
      for (std::uint32_t k = 0; k < 8; ++k) {
        const float point = source.density(q[k], level);
        cloudy += point > 0;
        // a noise is off by up to 1e-6 (fractions rounded to 2^-24 of a cell, slope 8), the ramp by that over the softness of 0.06 or more;
        // ten times that for the sums
        EXPECT_NEAR(column.v[k], point, 2e-4f * source.maxExtinction()) << layer.name << " level " << level << " sample " << k;
      }
    }
    EXPECT_GT(cloudy, 500) << layer.name;
  }
}

TEST(Layers, SlabIsConstantInside) {
  const auto slab = LayeredClouds::slab({1000, 3000, 0.02}, kRoot);
  const glm::dvec3 up = glm::normalize(glm::dvec3(1, 2, 3));
  EXPECT_FLOAT_EQ(slab->density(kRoot.toFixed(up * (6'371'000 + 2000.0)), 18), 0.02f);
  EXPECT_EQ(slab->density(kRoot.toFixed(up * (6'371'000 + 900.0)), 18), 0.0f);
  const auto inside = slab->bounds(shared::nodeCorner(kRoot.toFixed(up * (6'371'000 + 2000.0)), 16), 16);
  EXPECT_TRUE(inside.constant());
  EXPECT_FLOAT_EQ(inside.hi, 0.02f);
  EXPECT_TRUE(slab->bounds(shared::nodeCorner(kRoot.toFixed(up * (6'371'000 + 9000.0)), 14), 14).empty());
}

}  // namespace
}  // namespace welkin
