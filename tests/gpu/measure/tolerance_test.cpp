// The error as the input: what is picked keeps it, costs less where more is allowed, and says so where nothing keeps it.
#include "welkin/measure/tolerance.h"

#include "gl_fixture.h"
#include "small_earth.h"

namespace welkin::measure {
namespace {
using namespace test;
using ToleranceChoice = GlTest;

std::unique_ptr<Renderer> rendererOf(gpu::Context& context, const View& view) {
  Scene scene = smallEarth();
  scene.quality.detail = 8;  // settles in a second
  auto made = Renderer::create(context, scene, {.width = 96, .height = 54, .timing = false});
  EXPECT_TRUE(made.ok());
  if (!made.ok()) return nullptr;
  EXPECT_TRUE((*made)->settle(view).residency.settled);
  return std::move(*made);
}

TEST_F(ToleranceChoice, KeepsWhatIsAskedAndCostsLessForMore) {
  const View view = viewAt(45, 0, 9000, 0, -12);
  const auto renderer = rendererOf(*context, view);
  ASSERT_NE(renderer, nullptr);
  double lastCost = 1e9, lastReached = 0;
  for (const double asked : {1.0, 3.0, 9.0}) {
    const auto kept = keepTolerance(*renderer, view, 0, asked);
    ASSERT_TRUE(kept.ok()) << kept.error().message;
    EXPECT_TRUE(kept->choice.kept) << asked;
    EXPECT_LE(kept->reached_255, asked);
    EXPECT_NEAR(kept->reached_255, kept->choice.estimate_255, 1e-9);  // so small a picture is tried whole
    EXPECT_GE(kept->reached_255, lastReached);
    EXPECT_LE(kept->choice.cost, lastCost);
    lastCost = kept->choice.cost, lastReached = kept->reached_255;
  }
  EXPECT_GT(lastReached, 0.5);  // not always the finest
  const auto again = chooseMarch(*renderer, view, 0, 9, DrawnAs::Whole);
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(again->cost, lastCost);  // counted, not timed
  EXPECT_GT(again->quality.spread, 0);
  const auto flown = chooseMarch(*renderer, view, 0, 9, DrawnAs::Reprojected);
  ASSERT_TRUE(flown.ok());
  EXPECT_EQ(flown->quality.spread, 0);
}

TEST_F(ToleranceChoice, SaysWhatCannotBeKept) {
  const View view = viewAt(45, 0, 9000, 0, -12);
  const auto renderer = rendererOf(*context, view);
  ASSERT_NE(renderer, nullptr);
  const auto choice = chooseMarch(*renderer, view, 0, 0.01, DrawnAs::Whole);
  ASSERT_TRUE(choice.ok());
  EXPECT_FALSE(choice->kept);
  EXPECT_EQ(choice->quality.step, kSteps[0]);
  EXPECT_GT(choice->finest_255, 0.01);
}

TEST_F(ToleranceChoice, WithoutCloudsThereIsNothingToPick) {
  Scene scene = smallEarth();
  scene.clouds.reset();
  auto renderer = Renderer::create(*context, scene, {.width = 32, .height = 18});
  ASSERT_TRUE(renderer.ok());
  const auto choice = chooseMarch(**renderer, viewAt(0, 0, 1000, 0, 0), 0, 1, DrawnAs::Whole);
  ASSERT_TRUE(choice.ok());
  EXPECT_TRUE(choice->kept);
  EXPECT_EQ(choice->tried, 0);
}

}  // namespace
}  // namespace welkin::measure
