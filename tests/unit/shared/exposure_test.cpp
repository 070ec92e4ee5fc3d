// The arithmetic of metering.
#include <gtest/gtest.h>

#include <cmath>

#include "welkin/shared/exposure.glsl.h"

namespace welkin::shared {
namespace {

TEST(ExposureBins, RiseWithLuminanceAndHoldTheirMiddle) {
  uint last = 0;
  for (double stops = -40; stops < 40; stops += 0.003) {
    const float y = float(std::exp2(stops));
    const uint bin = exposureBin(y);
    ASSERT_GE(bin, last);
    ASSERT_LT(bin, kExposureBins);
    last = bin;
    if (stops < kLowestStop || stops >= kLowestStop + 32) continue;
    // The widest bin, from 1 to 9/8 of a power of two, is 0.17 stops; its middle in light is 0.0875 from the lower end.
    ASSERT_NEAR(exposureBinStops(bin), stops, 0.0876) << y;
  }
  EXPECT_EQ(exposureBin(float(std::exp2(-28))), 0u);
  EXPECT_EQ(exposureBin(std::nextafter(16.0f, 0.0f)), 255u);
  EXPECT_EQ(exposureBin(1e-45f), 0u) << "denormal light is the darkest";
  EXPECT_EQ(exposureBin(INFINITY), 255u);
}

TEST(ExposureRanks, AreNeverEmptyAndShareOutAllPixels) {
  for (const uint pixels : {1u, 2u, 3u, 10u, 14400u, 1u << 28})
    for (const auto& [low, high] : {std::pair{0.0f, 1.0f}, {0.1f, 0.9f}, {0.5f, 0.5f}, {1.0f, 1.0f}, {0.0f, 0.0f}}) {
      const uvec2 ranks = exposureRanks(pixels, low, high);
      ASSERT_LT(ranks.x, ranks.y) << pixels << " " << low;
      ASSERT_LE(ranks.y, pixels);
      // Bins of a seventh each: their weights sum to what lies between the ranks.
      uint before = 0, sum = 0;
      for (uint i = 0; i < 7; ++i) {
        const uint count = i < 6 ? pixels / 7 : pixels - before;
        sum += exposureWeight(before, count, ranks);
        before += count;
      }
      ASSERT_EQ(sum, ranks.y - ranks.x);
    }
  EXPECT_EQ(exposureRanks(1000, 0.25f, 0.75f), uvec2(250, 750));
}

TEST(ExposureAdaptation, GoesItsShareOfTheWay) {
  EXPECT_FLOAT_EQ(exposureAdapted(0, 4, {0.5f, 0.25f}), 1) << "towards a brighter exposure";
  EXPECT_FLOAT_EQ(exposureAdapted(0, -4, {0.5f, 0.25f}), -2) << "towards a darker one";
  EXPECT_EQ(exposureAdapted(3, -4, {1, 1}), -4) << "all the way is exact";
  EXPECT_EQ(exposureAdapted(3, -4, {0, 0}), 3);
}

TEST(ExposureSteps, RoundAndScale) {
  EXPECT_EQ(exposureSteps(0), 0);
  EXPECT_EQ(exposureSteps(1.0f / 512), 1);
  EXPECT_EQ(exposureSteps(-1), -256);
  for (int n = -126; n < 128; ++n) ASSERT_EQ(powerOfTwo(n), std::exp2(float(n)));
}

}  // namespace
}  // namespace welkin::shared
