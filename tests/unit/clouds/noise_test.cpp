#include <gtest/gtest.h>

#include <random>

#include "random32.h"
#include "welkin/shared/noise.glsl.h"

namespace welkin::shared {
namespace {

using Random = test::Random32;

uvec3 randomPosition(Random& random) { return {random(), random(), random()}; }

TEST(Noise, RangeMeanVarianceAndBillowMean) {
  Random random(5);
  constexpr int kSamples = 2'000'000;
  double sum = 0, squares = 0, magnitude = 0;
  int clamped = 0;
  for (int i = 0; i < kSamples; ++i) {
    const double n = static_cast<double>(noise3(randomPosition(random), 20, 20, static_cast<uint>(i / 1000)));
    ASSERT_LE(std::abs(n), 1);
    sum += n, squares += n * n, magnitude += std::abs(n);
    clamped += std::abs(n) >= 1;
  }
  // five standard errors: sigma / sqrt(N) = 2.4e-4, of sigma and of the mean magnitude 1.7e-4 and 1.4e-4
  EXPECT_NEAR(sum / kSamples, 0, 1.2e-3);
  EXPECT_NEAR(std::sqrt(squares / kSamples), static_cast<double>(kNoiseSigma), 9e-4);
  EXPECT_NEAR(magnitude / kSamples, static_cast<double>(kNoiseAbsMean), 7e-4);
  EXPECT_NEAR(std::sqrt(squares / kSamples - std::pow(magnitude / kSamples, 2)), static_cast<double>(kNoiseAbsSigma), 9e-4);
  EXPECT_LT(clamped, kSamples * 2e-3);
}

TEST(Noise, SlopeStaysBelowTheLipschitzConstantAndComesNearIt) {
  Random random(6);
  constexpr uint kShift = 20;
  const uint step = 1u << (kShift - 10);
  float steepest = 0;
  for (int i = 0; i < 500'000; ++i) {
    const uvec3 p = randomPosition(random);
    uvec3 q = p;
    q[i % 3] += step;
    steepest = std::max(steepest, std::abs(noise3(q, kShift, kShift, 9) - noise3(p, kShift, kShift, 9)) * 1024);
  }
  EXPECT_LE(steepest, kNoiseLipschitz);
  EXPECT_GT(steepest, 0.4f * kNoiseLipschitz);  // half a million random gradients come this near the extreme choice of all eight
}

TEST(Noise, VanishesOnTheLatticeAndGoesOnAcrossTheRootsEdge) {
  Random random(7);
  for (int i = 0; i < 1000; ++i) {
    const uvec3 p = randomPosition(random);
    EXPECT_EQ(noise3({p.x & ~0xFFFFFu, p.y & ~0xFFFFFu, p.z & ~0xFFFFFu}, 20, 20, 1), 0.0f);
    const float inside = noise3({0xFFFFFFFFu, p.y, p.z}, 20, 20, 1), beyond = noise3({0u, p.y, p.z}, 20, 20, 1);
    EXPECT_NEAR(inside, beyond, kNoiseLipschitz * 0x1p-20f + 1e-6f);  // one step apart, plus rounding
  }
}

TEST(Noise, CellFractionIsExact) {
  EXPECT_EQ(cellFraction(0xDEADBEEFu, 8), static_cast<float>(0xEF) / 256);
  EXPECT_EQ(cellFraction(0xFFFFFFFFu, 31), 1 - 0x1p-24f);  // 24 bits are kept
  EXPECT_EQ(cellFraction(0x80000000u, 31), 0.0f);
}

TEST(Noise, NeighbouringLatticePointsAreUncorrelated) {
  // hashes of lattice points one apart: each output bit flips half of the time
  int flips[32] = {};
  constexpr int kPairs = 20000;
  for (uint i = 0; i < kPairs; ++i) {
    const uint a = mixBits(latticeX(i << 4, 4, 0) ^ latticeY(77u << 4, 4, 0)),
               b = mixBits(latticeX(i << 4, 4, 1) ^ latticeY(77u << 4, 4, 0));
    for (uint k = 0; k < 32; ++k) flips[k] += static_cast<int>(((a ^ b) >> k) & 1u);
  }
  for (int f : flips) EXPECT_NEAR(f, kPairs / 2, 5 * 71);  // five standard errors of sqrt(N) / 2 = 71
}

}  // namespace
}  // namespace welkin::shared
