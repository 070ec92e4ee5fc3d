#include "welkin/window/render_scale.h"

#include <gtest/gtest.h>

#include <cmath>

namespace welkin::window {
namespace {

// A machine on which a frame takes `fixed_ms` and `full_ms` more for all of the window's pixels.
double settledScale(double fixed_ms, double full_ms, RenderScale& scale, int frames = 4000) {
  for (int i = 0; i < frames; ++i) scale.frame(fixed_ms + full_ms * scale.scale() * scale.scale());
  return scale.scale();
}

TEST(RenderScale, FirstPictureIsTheSmallest) { EXPECT_EQ(RenderScale().scale(), 0.25); }

TEST(RenderScale, FastMachinesDrawEveryPixel) {
  RenderScale scale;
  EXPECT_EQ(settledScale(2, 6, scale), 1);
}

TEST(RenderScale, FramesStayWithinTheirTime) {
  for (const double full_ms : {20.0, 60.0, 150.0, 400.0}) {
    RenderScale scale;
    const double s = settledScale(12, full_ms, scale);
    EXPECT_TRUE(s == 0.25 || 12 + full_ms * s * s <= kMostFrame_ms) << full_ms;
    // And not smaller than need be: twice the pixels, and what the guess of their cost is off by, would not fit.
    EXPECT_TRUE(s == 1 || (12 + full_ms * s * s) * 1.6 >= kMostFrame_ms) << full_ms;
  }
}

TEST(RenderScale, TriesThatFailBecomeRare) {
  RenderScale scale;
  const auto cost_ms = [&] { return scale.scale() > 0.25 ? 60.0 : 20.0; };  // looks cheap from below, and is not
  int failed = 0;
  for (int i = 0; i < 4000; ++i) {
    failed += scale.scale() > 0.25;
    scale.frame(cost_ms());
  }
  EXPECT_LT(failed, 150);  // each try is seen through in 8 frames; without patience it would be every fourth frame
}

TEST(RenderScale, OneSlowFrameChangesNothing) {
  RenderScale scale;
  settledScale(2, 6, scale);
  scale.frame(500);
  EXPECT_EQ(settledScale(2, 6, scale, 8), 1);
}

TEST(RenderScale, SharperAtRestAndBackAtOnce) {
  RenderScale scale;
  const double moving = settledScale(12, 150, scale);
  for (int i = 0; i < 1000; ++i) scale.frame(12 + 150 * scale.scale() * scale.scale(), true);
  EXPECT_GT(scale.scale(), moving);
  EXPECT_LE(12 + 150 * scale.scale() * scale.scale(), kMostRest_ms);
  scale.frame(12, false);
  EXPECT_EQ(scale.scale(), moving);
}

// What was too slow while a tree was made may do at rest: it is tried as soon as from the start.
TEST(RenderScale, TriesThatFailedWhileMovingDoNotHoldARestBack) {
  RenderScale scale;
  settledScale(5, 330, scale);  // 26 ms at a quarter, so that more is tried; 45 at 0.35, so that it fails
  const double before = scale.scale();
  for (int i = 0; i < 60; ++i) scale.frame(45, true);
  EXPECT_GT(scale.scale(), before);
}

TEST(RenderScale, SizesOfTinyAndMinimisedWindows) {
  const RenderScale scale;
  EXPECT_EQ(scale.sizeFor({1280, 800}).width, 320);
  EXPECT_EQ(scale.sizeFor({1280, 800}).height, 200);
  EXPECT_EQ(scale.sizeFor({3, 3}).width, 16);
  EXPECT_EQ(scale.sizeFor({0, 0}).width, 0);
}

TEST(RenderScale, ChosenByHandItStays) {
  RenderScale scale;
  scale.set(0.6);
  EXPECT_EQ(scale.scale(), 0.5);
  EXPECT_EQ(settledScale(500, 500, scale), 0.5);
}

}  // namespace
}  // namespace welkin::window
