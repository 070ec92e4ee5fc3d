// Bounds against samples: random nodes on random levels, samples of bricks of the node's own and deeper levels.
#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "random32.h"
#include "welkin/clouds/default_layers.h"
#include "welkin/clouds/layers_source.h"
#include "welkin/clouds/noise_bounds.h"
#include "welkin/clouds/sphere_source.h"
#include "welkin/shared/cloud_layers.glsl.h"

namespace welkin {
namespace {

using Random = test::Random32;

const RootFrame kRoot = RootFrame::enclosing(6'371'000, 12'000);

glm::dvec3 randomDirection(Random& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

LayeredClouds earth(std::uint32_t seed) {
  const ProceduralWeather weather(seed);
  return LayeredClouds(defaultEarthLayers(), CoverMap::bake(256, [&](glm::dvec3 d) { return weather.at(d); }), kRoot, seed, {});
}

void expectContained(const DensitySource& source, std::uint32_t seed, int nodes, glm::dvec3 around = {}) {
  Random random(seed);
  int samples = 0, cloudy = 0;
  for (int i = 0; i < nodes; ++i) {
    const std::uint32_t level = random() % 19;
    const double h = source.base_m() - 500 + (source.top_m() - source.base_m() + 1000) * static_cast<double>(random() % 1000) / 1000;
    const glm::uvec3 inside = kRoot.toFixed(around == glm::dvec3{} ? randomDirection(random) * (kRoot.planetRadius_m + h)
                                                                   : around + 2.2e4 * randomDirection(random));
    const glm::uvec3 corner = shared::nodeCorner(inside, level);
    const Bounds bounds = source.bounds(corner, level);
    ASSERT_LE(bounds.lo, bounds.hi);
    for (int k = 0; k < 16; ++k) {
      // a brick of this or a deeper level inside the node, and one of its corner samples, the far side included
      const std::uint32_t deep = std::min(level + (random() % 5) * (random() % 3), shared::kMaxDepth);
      glm::uvec3 q = inside;
      if (k % 2)
        for (int a = 0; a < 3; ++a) q[a] = corner[a] + (random() & shared::levelMask(level));
      const glm::uvec3 p = shared::brickSample(shared::nodeCorner(q, deep), deep, glm::uvec3(random() % 8, random() % 8, random() % 8));
      const float density = source.density(p, deep);
      ASSERT_GE(density, bounds.lo) << "seed " << seed << " node " << i << " level " << level << " sample level " << deep;
      ASSERT_LE(density, bounds.hi) << "seed " << seed << " node " << i << " level " << level << " sample level " << deep;
      ++samples;
      cloudy += density > 0;
    }
  }
  EXPECT_GT(cloudy, samples / 50);  // the test has met cloud
}

TEST(Bounds, ContainSamplesOfLayers) {
  for (std::uint32_t seed : {1u, 2u, 3u}) expectContained(earth(seed), seed, 8000);
}

TEST(Bounds, ContainSamplesUnderFullCover) {
  for (const CloudLayer& layer : defaultEarthLayers()) {
    CloudLayer l = layer;
    l.coverGain = 0, l.coverBias = 0.5, l.typeLow = l.typeHigh = 0;
    expectContained(LayeredClouds({l}, std::nullopt, kRoot, 11, {}), 11, 3000);
  }
}

// From emptyFrom() on a brick of zeros is taken for an empty node. What may be below it: nothing nearly everywhere, and where the noise
// that the brick does not show is past the end of its distribution, wisps.
TEST(EmptyFrom, HardlyAnythingIsBelowABrickOfZeros) {
  Random random(9);
  int zeros = 0, samples = 0, cloudy = 0;
  double sum = 0, all = 0;
  for (std::uint32_t seed : {1u, 2u}) {
    const LayeredClouds source = earth(seed);
    const std::uint32_t from = source.emptyFrom();
    ASSERT_LE(from, 10u);
    for (int i = 0; i < 8000; ++i) {
      const std::uint32_t level = from + random() % 5;
      const double h = source.base_m() + (source.top_m() - source.base_m()) * static_cast<double>(random() % 1000) / 1000;
      const glm::uvec3 corner = shared::nodeCorner(kRoot.toFixed(randomDirection(random) * (kRoot.planetRadius_m + h)), level);
      if (source.bounds(corner, level).empty()) continue;
      const float stored = source.maxExtinction() / 131070;  // less becomes 0 in 16 bits
      bool zero = true;
      for (std::uint32_t k = 0; k < 512 && zero; ++k)
        zero = source.density(shared::brickSample(corner, level, {k & 7, (k >> 3) & 7, k >> 6}), level) < stored;
      zeros += zero;
      for (int k = 0; k < 40; ++k) {
        const glm::uvec3 p = corner + glm::uvec3(random(), random(), random()) % (shared::levelMask(level) + 1);
        const float density = source.density(p, shared::kMaxDepth) / source.maxExtinction();
        all += static_cast<double>(density);
        if (!zero) continue;
        ++samples;
        cloudy += density > 1e-3f;
        sum += static_cast<double>(density);
      }
    }
  }
  ASSERT_GT(zeros, 500);
  std::printf("%d bricks of zeros, %d of %d samples below them over 1e-3 of the maximum, share of all cloud %.2g\n", zeros, cloudy, samples,
              sum / all);
  EXPECT_LT(cloudy, samples / 10000);  // two levels coarser, where the largest lumps do not show, 20 times as many
  EXPECT_LT(sum, 1e-5 * all);          // there 5e-4
}

TEST(Bounds, ContainSamplesOfSphereAndSlab) {
  expectContained(SphereCloud({{5.6e6, 0, 3e6}, 2e4, 0.01}, kRoot), 5, 4000, {5.6e6, 0, 3e6});
  expectContained(*LayeredClouds::slab({500, 3000, 0.02}, kRoot), 6, 4000);
}

TEST(Bounds, NoiseIntervalsContainTheNoise) {
  Random random(8);
  double width = 0;
  int tight = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::uint32_t size = 8 + random() % 12, shift = size + random() % 8, streak = random() % 3;
    const std::uint32_t zShift = std::max(size, shift - std::min(streak, shift - size));
    const std::uint32_t mask = (1u << size) - 1;
    const glm::uvec3 corner(random() & ~mask, random() & ~mask, random() & ~mask);
    const Interval bounds = noiseInterval(corner, size, shift, zShift, 77);
    for (int k = 0; k < 20; ++k) {
      glm::uvec3 p = corner;
      for (int a = 0; a < 3; ++a) p[a] += k < 8 ? ((k >> a) & 1 ? mask + 1 : 0u) : random() & mask;
      const float n = shared::noise3(p, shift, zShift, 77);
      ASSERT_GE(n, bounds.lo) << i;
      ASSERT_LE(n, bounds.hi) << i;
    }
    if (shift == size + 4) width += static_cast<double>(bounds.hi - bounds.lo), ++tight;
  }
  EXPECT_LT(width / tight, 1.2);  // a box of a sixteenth of the cell; the Lipschitz constant alone would give 1.5
}

TEST(Bounds, ClearSkyIsSeenAndCallsAreQuick) {
  const LayeredClouds source = earth(1);
  Random random(9);
  int clear = 0, clearFound = 0;
  std::vector<std::pair<glm::uvec3, std::uint32_t>> nodes;
  for (int i = 0; i < 20000; ++i) {
    const std::uint32_t level = 9 + random() % 8;
    const glm::uvec3 corner =
        shared::nodeCorner(kRoot.toFixed(randomDirection(random) * (kRoot.planetRadius_m + 1000 + random() % 2000)), level);
    nodes.emplace_back(corner, level);
    const float cover = shared::coverAt(source.view(), shared::coverPlace(corner), 0);
    if (cover > 0) continue;
    ++clear;
    clearFound += source.bounds(corner, level).empty();
  }
  EXPECT_GT(clearFound, clear * 0.75);
  const auto start = std::chrono::steady_clock::now();
  int empty = 0;
  for (const auto& [corner, level] : nodes) empty += source.bounds(corner, level).empty();
  const double us =
      std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count() / static_cast<double>(nodes.size());
  std::printf("%.2f us a call, %d of %zu nodes empty, %d of %d clear nodes found\n", us, empty, nodes.size(), clearFound, clear);
  EXPECT_LT(us, 100);  // measured 2; room for sanitizers and a busy machine
}

}  // namespace
}  // namespace welkin
