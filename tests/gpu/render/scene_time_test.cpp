// A renderer whose time goes on: the sun moves over clouds that are there, clouds drift over the ground. In the end each picture is the one
// of a renderer that was made then.
#include <lodepng.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "flights.h"
#include "welkin/physics/scene_time.h"

namespace welkin {
namespace {
using namespace test;
using SceneTimeTest = GlTest;

Image8 madeThen(gpu::Context& context, const Scene& scene, double time_s, const View& view) {
  const auto renderer = makeRenderer(context, scene, {.width = 128, .height = 72, .time_s = time_s});
  if (!renderer) return {};
  renderer->settle(view);
  renderer->frame(view, FrameMode::Full);
  return renderer->image();
}

Scene withDay() {
  Scene scene = quickEarth();
  scene.sun->day_s = 86'400;
  return scene;
}

constexpr double kLater_s = 5400;  // 22.5 degrees: shadows are elsewhere

TEST_F(SceneTimeTest, TheSunMovesOverClouds) {
  const View view = sideways(0, 0);
  const auto renderer = makeRenderer(*context, withDay());
  ASSERT_NE(renderer, nullptr);
  renderer->settle(view);
  renderer->frame(view, FrameMode::Full);
  const Image8 before = renderer->image(), wanted = madeThen(*context, withDay(), kLater_s, view);
  EXPECT_GT(pixelError(before, wanted).rmse, 0.02) << "else nothing is tested";
  renderer->setTime(kLater_s);
  FrameStats stats;
  double stale_deg = 0;
  int frames = 0;
  std::uint64_t lit = 0;
  do {
    stats = renderer->frame(view);
    stale_deg = std::max(stale_deg, stats.lightStale_deg);
    lit += stats.bricksLit;
    EXPECT_LE(stats.bricksLit, 256u) << "a frame's worth";
    EXPECT_EQ(stats.counters.nanPixels, 0u);
  } while (++frames < 400 && !(stats.residency.settled && frames > 8));
  std::printf("%d frames, %lu bricks of %u lit again, %.2f degrees behind at most\n", frames, static_cast<unsigned long>(lit),
              stats.residency.bricks, stale_deg);
  const double moved_deg = 2 * 180 / M_PI * std::asin(std::sin(11.25 * M_PI / 180) * std::cos(20 * M_PI / 180));  // at 20 degrees of declination
  EXPECT_NEAR(stale_deg, moved_deg, 1e-5) << "told at once; floats keep where it was";
  EXPECT_EQ(stats.lightStale_deg, 0);
  EXPECT_LE(lit, stats.residency.bricks) << "each once";
  renderer->frame(view, FrameMode::Full);
  const PixelError error = pixelError(renderer->image(), wanted);
  std::printf("greatest difference %d of 255\n", error.max_255);
  EXPECT_LE(error.max_255, 1) << "the same passes over the same tree";
}

// Moved by less than its disc and then at rest, it is followed to the end all the same.
TEST_F(SceneTimeTest, ASmallMoveIsFollowedOnceItRests) {
  const View view = sideways(0, 0);
  const auto renderer = makeRenderer(*context, withDay());
  ASSERT_NE(renderer, nullptr);
  renderer->settle(view);
  renderer->setTime(50);  // 0.2 degrees
  const FrameStats stats = renderer->settle(view);
  EXPECT_EQ(stats.lightStale_deg, 0);
  EXPECT_GE(stats.bricksLit, stats.residency.bricks - 1);
}

// What nobody sees gets its light last.
TEST_F(SceneTimeTest, WhatIsSampledIsLitFirst) {
  const View view = sideways(0, 0);
  const auto renderer = makeRenderer(*context, withDay(), {.width = 128, .height = 72, .bricksPerFrame = 64});
  ASSERT_NE(renderer, nullptr);
  renderer->settle(view);
  renderer->setTime(kLater_s);
  std::uint64_t toExact = 0, toSettled = 0;
  for (int i = 0; i < 600; ++i) {
    const FrameStats stats = renderer->frame(view);
    if (i < 4) continue;  // edits of before
    if (stats.lightStale_deg > 0) toExact += stats.bricksLit;
    toSettled += stats.bricksLit;
    if (stats.residency.settled) break;
  }
  std::printf("%lu bricks lit until all that is seen was, %lu in all\n", static_cast<unsigned long>(toExact), static_cast<unsigned long>(toSettled));
  EXPECT_GT(toExact, 64u);
  EXPECT_LT(double(toExact), 0.8 * double(toSettled));
}

// The wind is a rigid rotation: clouds, view and sun turned against it are the same picture. A plain ground does not show the turn.
TEST_F(SceneTimeTest, WindIsARotation) {
  const View view = sideways(0, 0);
  Scene windy = quickEarth();
  windy.clouds->windEast_m_per_s = 50;
  const double turn_rad = windTurn_rad(windy, kLater_s);
  const Image8 drifted = madeThen(*context, windy, kLater_s, view);
  Scene still = quickEarth();
  EXPECT_GT(pixelError(drifted, madeThen(*context, still, kLater_s, view)).rmse, 0.02) << "270 km: other clouds";
  still.sun->direction_planet = turned(still.sun->direction_planet, -turn_rad);
  EXPECT_LE(pixelError(drifted, madeThen(*context, still, 0, turned(view, -turn_rad))).max_255, 0);
  // And drifting there frame by frame ends with the same.
  const auto renderer = makeRenderer(*context, windy);
  ASSERT_NE(renderer, nullptr);
  renderer->settle(view);
  for (int i = 1; i <= 4; ++i) {
    renderer->setTime(i * kLater_s / 4);
    renderer->frame(view);
  }
  renderer->settle(view);
  renderer->frame(view, FrameMode::Full);
  const PixelError error = pixelError(renderer->image(), drifted);
  std::printf("greatest difference %d of 255, over 1: %.5f\n", error.max_255, error.shareOver1);
  EXPECT_LE(error.shareOver1, 0.01) << "the tree remembers where it came from: hysteresis keeps some nodes";
}

// The ground does not drift with the clouds: through clear ones it looks as before.
TEST_F(SceneTimeTest, TheGroundStaysUnderTheWind) {
  const auto file = std::filesystem::temp_directory_path() / ("welkin-ground-" + std::to_string(::getpid()) + ".png");
  std::vector<unsigned char> rgba;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x)
      for (const int v : {x * 2, y * 4, (x / 8 + y / 8) % 2 * 200, 255}) rgba.push_back(static_cast<unsigned char>(v));
  ASSERT_EQ(lodepng::encode(file.string(), rgba, 128, 64), 0u);
  Scene scene = quickEarth();
  scene.planet.albedoMap = file;
  scene.clouds = Clouds{{SlabSource{1000, 2000, 0}}, true};
  scene.clouds->windEast_m_per_s = 1000;
  const View view = viewAt(20, -40, 2e6, 0, -70);
  const Image8 before = madeThen(*context, scene, 0, view), after = madeThen(*context, scene, kLater_s, view);
  std::filesystem::remove(file);
  EXPECT_GT(contrast(before), 0.05) << "the squares are seen";
  EXPECT_GT(windTurn_rad(scene, kLater_s), 0.8);
  const PixelError error = pixelError(before, after);
  std::printf("greatest difference %d of 255, over 1: %.5f\n", error.max_255, error.shareOver1);
  // Texels' edges lie elsewhere by a float's last digits of the turn: 1.2e-7 of 128 texels, and rays in another frame by as much.
  EXPECT_LE(error.shareOver1, 0.01);
}

// Sun and clouds move, and frames are the same however the worker is delayed.
TEST_F(SceneTimeTest, PicturesAreTheSameForAnyTiming) {
  Scene scene = withDay();
  scene.clouds->windEast_m_per_s = 50;
  std::vector<Image8> first;
  for (const std::uint32_t jitter : {0u, 5u}) {
    const auto renderer = makeRenderer(*context, scene, {.width = 96, .height = 54, .bricksPerFrame = 64, .workerJitterSeed = jitter});
    ASSERT_NE(renderer, nullptr);
    renderer->settle(sideways(0, 0));
    for (int i = 0; i < 12; ++i) {
      renderer->setTime(i * 300.0);
      renderer->frame(sideways(i, 200));
      if (jitter == 0)
        first.push_back(renderer->image());
      else
        ASSERT_EQ(renderer->image().rgba, first[std::size_t(i)].rgba) << "frame " << i;
    }
  }
  EXPECT_GT(pixelError(first.front(), first.back()).rmse, 0.02) << "else nothing moved";
}

// A change of where the sun stands, of its day or of the wind needs no new light of the air.
TEST_F(SceneTimeTest, ThePanelsMoveTheSunAtOnce) {
  const View view = sideways(0, 0);
  const auto renderer = makeRenderer(*context, quickEarth());
  ASSERT_NE(renderer, nullptr);
  renderer->settle(view);
  Scene changed = withDay();
  changed.sun->direction_planet = sunStartOf(*changed.sun, directionTo(-5, 25), kLater_s);
  renderer->setTime(kLater_s);
  ASSERT_TRUE(renderer->setAir(changed, Renderer::AirChange::Recompute).ok());
  EXPECT_EQ(renderer->frame(view).skyProgress, 1);
  EXPECT_LT(glm::length(renderer->sunInClouds() - directionTo(-5, 25)), 1e-12);
  renderer->settle(view);
  renderer->frame(view, FrameMode::Full);
  Scene there = quickEarth();
  there.sun->direction_planet = directionTo(-5, 25);
  EXPECT_LE(pixelError(renderer->image(), madeThen(*context, there, 0, view)).max_255, 1);
}

// While the air's new light is made the sun goes on.
TEST_F(SceneTimeTest, TheSunGoesBeforeItsNewLight) {
  const View view = sideways(0, 0);
  Scene changed = withDay();
  changed.clouds.reset();  // the tree takes what memory there is, and two lights at once need some
  const auto renderer = makeRenderer(*context, changed, {.width = 128, .height = 72, .sky_ms = 1});
  ASSERT_NE(renderer, nullptr);
  renderer->setTime(kLater_s);
  changed.atmosphere->layers[0].scattering_per_m[0] *= 1.5;
  ASSERT_TRUE(renderer->setAir(changed, Renderer::AirChange::Recompute).ok());
  FrameStats stats;
  double progress = 0;
  for (int i = 0; i < 5; ++i) {
    const glm::dvec3 there = directionTo(10, 40 + i);
    changed.sun->direction_planet = sunStartOf(*changed.sun, there, kLater_s);
    ASSERT_TRUE(renderer->setAir(changed, Renderer::AirChange::Recompute).ok());
    EXPECT_LT(glm::length(renderer->sunInClouds() - there), 1e-12);
    stats = renderer->frame(view);
    EXPECT_GT(stats.skyProgress, progress) << "its making is not begun anew by each step of the sun";
    progress = stats.skyProgress;
  }
  EXPECT_LT(progress, 1);
  for (int i = 0; i < 2000 && (stats = renderer->frame(view)).skyProgress < 1; ++i) {}
  EXPECT_EQ(stats.skyProgress, 1);
  EXPECT_LT(glm::length(renderer->sunInClouds() - directionTo(10, 44)), 1e-12);
  renderer->frame(view, FrameMode::Full);
  EXPECT_LE(pixelError(renderer->image(), madeThen(*context, changed, kLater_s, view)).max_255, 1);
}

}  // namespace
}  // namespace welkin
