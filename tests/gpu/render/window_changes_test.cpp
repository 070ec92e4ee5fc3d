// What a window changes while it draws: size, exposure, tone curve, the pace of the worker.
#include <cstdio>

#include "flights.h"

namespace welkin {
namespace {
using namespace test;
using WindowChangesTest = GlTest;

Image8 fresh(gpu::Context& context, const Scene& scene, int width, int height, const View& view) {
  const auto renderer = makeRenderer(context, scene, {.width = width, .height = height});
  if (!renderer) return {};
  renderer->settle(view);
  renderer->frame(view, FrameMode::Full);
  return renderer->image();
}

// After a change of size the picture is that of a renderer that was made for it; the tree stays, and so does the account.
TEST_F(WindowChangesTest, ResizedIsAsMadeForIt) {
  const View view = sideways(0, 0);
  const auto renderer = makeRenderer(*context, quickEarth(), {.width = 64, .height = 36, .forced = {"nothing-moves"}});
  ASSERT_NE(renderer, nullptr);
  renderer->settle(view);
  for (int i = 0; i < 18; ++i) renderer->frame(view);
  const std::uint64_t targets = renderer->memory().frameTargets();
  ASSERT_TRUE(renderer->resize(128, 72).ok());
  EXPECT_EQ(renderer->image().width, 128);
  EXPECT_EQ(renderer->shown().spec().height, 72);
  EXPECT_GT(renderer->memory().frameTargets(), targets);
  const FrameStats first = renderer->frame(view);
  EXPECT_LT(first.counters.marchedPixels, 128u * 72u / 2) << "history came along: most pixels are not marched at once";
  const Image8 whole = fresh(*context, quickEarth(), 128, 72, view);
  const PixelError stretched = pixelError(renderer->image(), whole);
  std::printf("first picture: RMSE %.4f\n", stretched.rmse);
  EXPECT_LT(stretched.rmse, 0.06) << "history of half the size is seen; without it clouds are missing";
  for (int i = 0; i < 24; ++i) renderer->frame(view);
  const PixelError error = pixelError(renderer->image(), whole);
  std::printf("over 1/255: %.5f of pixels, greatest %d\n", error.shareOver1, error.max_255);
  EXPECT_LE(error.shareOver1, 0.002) << "every pixel was marched since: both go through the same 16-bit history";
  ASSERT_TRUE(renderer->resize(64, 36).ok());
  EXPECT_EQ(renderer->memory().frameTargets(), targets) << "back to the same bytes";
  EXPECT_EQ(context->debugMessages(), 0u);
}

TEST_F(WindowChangesTest, OutputChangedIsAsMadeWithIt) {
  const View view = sideways(0, 0);
  const auto renderer = makeRenderer(*context, quickEarth());
  ASSERT_NE(renderer, nullptr);
  renderer->settle(view);
  Output metered;
  metered.exposure_ev.reset();
  metered.autoExposure.compensation_ev = 1;
  Output fixed;
  fixed.exposure_ev = -1.5;
  fixed.toneCurve = ToneCurve::Uchimura;
  for (const Output& output : {metered, fixed}) {
    ASSERT_TRUE(renderer->setOutput(output).ok());
    EXPECT_EQ(renderer->plan().metered, !output.exposure_ev.has_value());
    renderer->frame(view, FrameMode::Full);
    Scene made = quickEarth();
    made.output = output;
    const PixelError error = pixelError(renderer->image(), fresh(*context, made, 128, 72, view));
    EXPECT_LE(error.max_255, 1) << "the same passes over the same tree, which two settlings may leave at one rounding's distance";
  }
}

// A worker that nobody waits for is asked again and again, never more than it has answered but two: the tree gets there, and rays
// never miss what they were promised.
TEST_F(WindowChangesTest, NotWaitingForTheWorkerTheTreeStillComes) {
  for (const std::uint32_t jitter : {0u, 7u}) {  // a worker as quick as it can be, and one with random delays
    const auto renderer =
        makeRenderer(*context, quickEarth(), {.width = 128, .height = 72, .workerJitterSeed = jitter, .waitForEdits = false});
    ASSERT_NE(renderer, nullptr);
    renderer->settle(sideways(0, 0));
    std::uint64_t generated = 0, holes = 0;
    for (int i = 0; i < 60; ++i) {
      const FrameStats stats = renderer->frame(sideways(i, 400));
      generated += stats.bricksGenerated;
      holes += stats.counters.holes;
    }
    EXPECT_GT(generated, 100u);
    int frames = 0;
    FrameStats stats;
    do stats = renderer->frame(sideways(60, 400));
    while (++frames < 2000 && !stats.residency.settled);
    std::printf("%lu bricks on the way, %lu holes, rest after %d frames\n", static_cast<unsigned long>(generated),
                static_cast<unsigned long>(holes), frames);
    EXPECT_LT(frames, 2000);
    EXPECT_EQ(stats.counters.holes, 0u);
  }
}

// The tree of a small picture is no finer than asked, and follows the picture's size.
TEST_F(WindowChangesTest, SpareDetailFollowsThePicture) {
  Scene scene = quickEarth(0);
  scene.quality.budget_bytes = 128ull << 20;
  const View view = sideways(0, 0);
  const auto renderer = makeRenderer(*context, scene, {.width = 32, .height = 18, .spareDetail = 1.2});
  ASSERT_NE(renderer, nullptr);
  const FrameStats small = renderer->settle(view);
  EXPECT_NEAR(small.residency.selectedDetail, 1.2 * renderer->shownDetail(view), 1e-6 * small.residency.selectedDetail);
  ASSERT_TRUE(renderer->resize(64, 36).ok());
  const FrameStats large = renderer->settle(view);
  EXPECT_NEAR(large.residency.selectedDetail, 1.2 * renderer->shownDetail(view), 1e-6 * large.residency.selectedDetail);
  EXPECT_GT(large.residency.bricks, small.residency.bricks);
}

}  // namespace
}  // namespace welkin
