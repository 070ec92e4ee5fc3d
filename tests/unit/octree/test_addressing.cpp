// Closed forms of the fixed-point addressing that shader and CPU share.
#include <gtest/gtest.h>

#include "random32.h"
#include "welkin/octree/max_code.h"
#include "welkin/shared/octree.glsl.h"

namespace welkin {
namespace {

using shared::uvec3;

TEST(Addressing, ChildCornersInvertChildOctants) {
  const std::uint32_t seed = 11;
  test::Random32 random(seed);
  for (int i = 0; i < 20000; ++i) {
    const uvec3 p(random(), random(), random());
    uvec3 corner(0);
    for (std::uint32_t level = 0; level < shared::kMaxDepth; ++level) {
      ASSERT_EQ(corner, shared::nodeCorner(p, level));
      corner = shared::childCorner(corner, level, shared::childOctant(p, level));
    }
    ASSERT_EQ(corner, shared::nodeCorner(p, shared::kMaxDepth));
  }
}

TEST(Addressing, OctantBitsAreXYZ) {
  EXPECT_EQ(shared::childOctant({0x80000000u, 0, 0}, 0), 1u);
  EXPECT_EQ(shared::childOctant({0, 0x80000000u, 0}, 0), 2u);
  EXPECT_EQ(shared::childOctant({0, 0, 0x40000000u}, 1), 4u);
  EXPECT_EQ(shared::levelMask(0), 0xFFFFFFFFu);
  EXPECT_EQ(shared::levelMask(24), 0xFFu);
  EXPECT_EQ(shared::levelSteps(0), 4294967296.0f);
  EXPECT_EQ(shared::levelSteps(24), 256.0f);
}

TEST(Addressing, BrickSamplesAreTheFloorOfSevenths) {
  for (std::uint32_t level = 1; level <= shared::kMaxDepth; ++level) {
    const std::uint64_t size = std::uint64_t{1} << (32 - level);
    for (std::uint32_t i = 0; i < 8; ++i)
      ASSERT_EQ(shared::brickSampleStep(i, level), i * size / 7) << "level " << level << " sample " << i;
  }
}

TEST(Addressing, NeighboursShareTheirFaceAndParentsTheirEvenSamples) {
  const std::uint32_t seed = 12;
  test::Random32 random(seed);
  for (int n = 0; n < 5000; ++n) {
    const std::uint32_t level = 1 + random() % 24;
    const uvec3 corner = shared::nodeCorner(uvec3(random(), random(), random()), level);
    const std::uint32_t j = random() % 8, k = random() % 8;
    const std::uint32_t size = shared::levelMask(level) + 1;
    const bool last = corner.x > 0xFFFFFFFFu - size;
    if (last) {
      ASSERT_EQ(shared::brickSample(corner, level, {7, j, k}).x, 0xFFFFFFFFu);  // the root's far face saturates
    } else {
      ASSERT_EQ(shared::brickSample(corner, level, {7, j, k}), shared::brickSample(corner + uvec3(size, 0, 0), level, {0, j, k}));
    }
    if (level == 1) continue;
    // Sample i of a child is half a sample of its parent: i + 7 * (which half) = 2 j. Exact, as the size of the child is whole.
    const uvec3 parent = shared::nodeCorner(corner, level - 1);
    const std::uint32_t half = parent.x == corner.x ? 0 : 1;
    for (std::uint32_t i = 0; i < 8; ++i) {
      if ((i + 7 * half) % 2 != 0) continue;
      ASSERT_EQ(shared::brickSample(corner, level, {i, 0, 0}).x, shared::brickSample(parent, level - 1, {(i + 7 * half) / 2, 0, 0}).x);
    }
  }
}

TEST(Addressing, WordsRoundTrip) {
  const std::uint32_t seed = 13;
  test::Random32 random(seed);
  for (int i = 0; i < 10000; ++i) {
    const std::uint32_t brick = random() & shared::kBrickMask, code = random() % 32, level = random() % 25;
    const std::uint32_t word = shared::packWord(brick, code, level);
    ASSERT_EQ(shared::wordBrick(word), brick);
    ASSERT_EQ(shared::wordMaxCode(word), code);
    ASSERT_EQ(shared::wordLevel(word), level);
    ASSERT_EQ(shared::wordEmpty(word), code == 0);
  }
}

TEST(MaxCode, RoundsUpAndIsTheLeast) {
  EXPECT_EQ(maxCodeFor(0), 0u);
  EXPECT_EQ(maxCodeFor(-1), 0u);
  EXPECT_EQ(maxCodeFor(1), 31u);
  EXPECT_EQ(maxCodeFor(2), 31u);
  EXPECT_EQ(maxCodeFor(1.0f / 65535), 1u);  // the least that 16 bits hold is not empty
  for (std::uint32_t code = 1; code <= 31; ++code) EXPECT_EQ(maxCodeFor(shared::maxCodeValue(code)), code);
  const std::uint32_t seed = 14;
  test::Random32 random(seed);
  for (int i = 0; i < 20000; ++i) {
    const float value = std::exp(std::uniform_real_distribution<float>(-12, 0)(random));
    const std::uint32_t code = maxCodeFor(value);
    ASSERT_GE(shared::maxCodeValue(code), value);
    if (code > 1) {
      ASSERT_LT(shared::maxCodeValue(code - 1), value);
    }
  }
}

TEST(Addressing, NodeExitLeavesTheNode) {
  const std::uint32_t seed = 15;
  test::Random32 random(seed);
  for (int i = 0; i < 20000; ++i) {
    const std::uint32_t level = random() % 25;
    const uvec3 p(random(), random(), random());
    std::normal_distribution<float> normal;
    const shared::vec3 d = glm::normalize(shared::vec3(normal(random), normal(random), normal(random)));
    const float t = shared::nodeExit(shared::nodeSteps(p, level), shared::levelSteps(level), shared::vec3(glm::greaterThanEqual(d, shared::vec3(0))), 1.0f / d);
    ASSERT_GE(t, 0);
    const shared::uvec3 lo = p & uvec3(shared::levelMask(level));
    // At t one axis is at a face and none is beyond: in units of steps, floats carry 24 of 32 bits.
    double beyond = -1e30;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = lo[axis] + static_cast<double>(d[axis]) * t;
      beyond = std::max(beyond, std::max(-at, at - shared::levelSteps(level)));
    }
    ASSERT_NEAR(beyond, 0, shared::levelSteps(level) * 4e-7) << "level " << level;
  }
}

}  // namespace
}  // namespace welkin
