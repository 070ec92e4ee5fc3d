// The renderer as a whole, on small pictures of a small Earth with made-up weather.
#include <cstdio>

#include "flights.h"

namespace welkin {
namespace {
using namespace test;
using RendererTest = GlTest;

constexpr std::size_t kPixels = 128 * 72;

// A camera that stands still in a finished tree costs no generation and no lighting, and what it shows is the full march.
TEST_F(RendererTest, StillCameraCostsNothingAndShowsTheFullMarch) {
  const auto renderer = makeRenderer(*context, quickEarth(), {.width = 128, .height = 72, .forced = {"nothing-moves"}});
  ASSERT_NE(renderer, nullptr);
  const View here = sideways(0, 0), beside = sideways(1, 40);
  const FrameStats settled = renderer->settle(here);
  ASSERT_TRUE(settled.residency.settled);
  EXPECT_GT(settled.bricksGenerated, 1000u) << "a tree worth testing";
  for (int i = 0; i < 100; ++i) {
    const FrameStats stats = renderer->frame(here);
    EXPECT_EQ(stats.bricksGenerated, 0u) << "frame " << i;
    EXPECT_EQ(stats.bricksLit, 0u) << "frame " << i;
    EXPECT_EQ(stats.counters.marchedPixels, i == 0 ? kPixels : kPixels / 16) << "the first frame has no history; frame " << i;
  }
  // History of another place: 40 m aside. Waits until the tree rests again, then for each pixel's turn.
  for (int i = 0; i < 4; ++i) renderer->frame(beside);
  FrameStats stats;
  int frames = 0;
  do stats = renderer->frame(here);
  while (++frames < 200 && !(stats.residency.settled && stats.bricksGenerated == 0));
  ASSERT_LT(frames, 200);
  for (int i = 0; i < 18; ++i) renderer->frame(here);  // two for edits on their way, and sixteen
  const Image8 reprojected = renderer->image();
  renderer->preview(here);
  const Image8 full = renderer->image();
  const PixelError error = pixelError(reprojected, full);
  std::printf("rested after %d frames; over 1/255: %.5f of pixels, greatest %d\n", frames, error.shareOver1, error.max_255);
  EXPECT_GT(contrast(full), 0.05);
  // Every pixel was marched at this very pose; both go through the same 16-bit history.
  EXPECT_LE(error.shareOver1, 0.001);
}

// In motion: history that is moved by the clouds' own distance stays near the full march of the same tree.
TEST_F(RendererTest, ReprojectionFollowsASidewaysFlight) {
  const auto renderer = makeRenderer(*context, quickEarth());
  ASSERT_NE(renderer, nullptr);
  renderer->settle(sideways(0, 0));
  double worst = 0;
  std::uint64_t marched = 0;
  for (int i = 0; i < 33; ++i) {
    const View view = sideways(i, 60);  // most of a pixel a frame for the clouds below, nothing at the horizon
    const FrameStats stats = renderer->frame(view);
    EXPECT_EQ(stats.counters.nanPixels, 0u);
    if (i > 0) marched += stats.counters.marchedPixels;
    if (i % 4 != 0 || i == 0) continue;
    const Image8 moved = renderer->image();
    renderer->preview(view);
    const PixelError error = pixelError(moved, renderer->image());
    worst = std::max(worst, error.rmse);
  }
  const double share = double(marched) / (32.0 * kPixels);
  std::printf("greatest RMSE %.4f; %.1f %% of pixels marched\n", worst, 100 * share);
  EXPECT_GT(worst, 0) << "the reprojected picture is another one than the full march";
  EXPECT_LE(worst, 0.015) << "limit of the design: 0.015 of full scale";
  EXPECT_LT(share, 0.5) << "reprojection that marches most pixels is none";
}

// Settling at a second place, after frames at the first whose edits are still on their way.
TEST_F(RendererTest, SettlingAtASecondPlaceReallySettles) {
  const auto renderer = makeRenderer(*context, quickEarth(4));
  ASSERT_NE(renderer, nullptr);
  const View here = sideways(0, 0), far = viewAt(-40, 10, 400e3, 0, -30);
  renderer->settle(here);
  for (int i = 0; i < 3; ++i) renderer->frame(here);
  const FrameStats moved = renderer->settle(far);
  EXPECT_TRUE(moved.residency.settled);
  EXPECT_GT(moved.bricksGenerated, 100u) << "half a planet away: its own bricks";
  const FrameStats again = renderer->settle(far);
  EXPECT_EQ(again.bricksGenerated, 0u);
  EXPECT_TRUE(again.residency.settled);
  renderer->preview(far);
  const Image8 travelled = renderer->image();
  // One that was never anywhere else shows the same: what stays of the first place is not in the picture.
  const auto fresh = makeRenderer(*context, quickEarth(4));
  const FrameStats there = fresh->settle(far);
  EXPECT_FLOAT_EQ(float(there.sampleDetail), float(again.sampleDetail));
  fresh->preview(far);
  const PixelError error = pixelError(travelled, fresh->image());
  std::printf("%u bricks here, %u there; RMSE %.5f\n", moved.residency.bricks, there.residency.bricks, error.rmse);
  EXPECT_GT(contrast(travelled), 0.02);
  EXPECT_LE(error.shareOver1, 0.001);
}

// From space to the ground: no NaN and no byte too many in any frame, while the tree is being built. Unless the tree is cold, or the fall
// so fast (20 % of the altitude a frame) that detail cannot glide after it, no ray meets a hole.
TEST_F(RendererTest, DescentIsSound) {
  for (const bool cold : {true, false}) {
    const int frames = cold ? 60 : 240;
    const auto renderer = makeRenderer(*context, quickEarth(0), {.width = 96, .height = 54});
    ASSERT_NE(renderer, nullptr);
    const auto pose = [&](int i) {
      const double x = double(i) / (frames - 1);
      return viewAt(kLatitude_deg, kLongitude_deg + 0.12 * x, 1e6 * std::pow(2e-6, x), 30, -60 + 70 * x);  // 1000 km to 2 m
    };
    if (!cold) renderer->settle(pose(0));
    std::uint64_t generated = 0, rays = 0, holes = 0;
    for (int i = 0; i < frames; ++i) {
      const FrameStats stats = renderer->frame(pose(i));
      EXPECT_EQ(stats.counters.nanPixels, 0u) << "frame " << i;
      EXPECT_LE(stats.bytesUsed, stats.bytesBudget) << "frame " << i;
      EXPECT_LE(stats.residency.bricks, stats.residency.brickCapacity) << "frame " << i;
      EXPECT_TRUE(cold || stats.counters.holes == 0) << "frame " << i << ": " << stats.counters.holes << " rays met a hole";
      generated += stats.bricksGenerated, rays += stats.counters.marchedPixels, holes += stats.counters.holes;
      if (i % 4 != 0) continue;
      for (const float v : renderer->radiance().rgba) ASSERT_TRUE(std::isfinite(v) && v >= 0) << "frame " << i;
    }
    std::printf("%s: %lu bricks generated on the way, %lu rays, %lu met a hole\n", cold ? "cold and fast" : "settled", generated, rays,
                holes);
    EXPECT_GT(generated, 5000u);
  }
}

}  // namespace
}  // namespace welkin
