// What a plan leaves out: for every reason there is a scene where it holds, something is saved there, and the picture stays.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <random>

#include "flights.h"
#include "welkin/core/files.h"
#include "welkin/physics/air.h"

namespace welkin {
namespace {
using namespace test;

const std::filesystem::path kFolder = std::filesystem::path(WELKIN_SOURCE_DIR) / "benchmarks/left-out";
constexpr int kWidth = 96, kHeight = 54;

Scene sceneOf(const std::string& name) {
  auto scene = loadScene(kFolder / (name + ".json"));
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().message);
  return scene.ok() ? std::move(*scene) : Scene{};
}
View viewOf(const Scene& scene) { return scene.views.begin()->second; }

bool holds(const FramePlan& plan, const std::string& name) {
  return std::any_of(plan.leftOut.begin(), plan.leftOut.end(), [&](const LeftOut& l) { return l.name == name; });
}
PlanFor picture(const View& view) { return {.view = view, .onePicture = true, .linear = false, .aspect = double(kWidth) / kHeight}; }
PlanFor flight(const View& view) { return {.view = view, .linear = false, .aspect = double(kWidth) / kHeight}; }

TEST(LeftOutReasons, EachHasASceneWhereItHoldsAndCanBeForced) {
  for (const std::string& name : leftOutReasons()) {
    ASSERT_TRUE(std::filesystem::exists(kFolder / (name + ".json"))) << name;
    const Scene scene = sceneOf(name);
    PlanFor asked = holds(planFrame(scene, picture(viewOf(scene))), name) ? picture(viewOf(scene)) : flight(viewOf(scene));
    const FramePlan plan = planFrame(scene, asked);
    ASSERT_TRUE(holds(plan, name)) << name;
    for (const LeftOut& l : plan.leftOut) {
      EXPECT_FALSE(l.what.empty() || l.reason.empty()) << name;
      EXPECT_TRUE(std::count(leftOutReasons().begin(), leftOutReasons().end(), l.name)) << l.name;
    }
    asked.forced = {name};
    EXPECT_FALSE(holds(planFrame(scene, asked), name)) << name;
  }
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
    const std::string name = entry.path().stem().string();
    EXPECT_TRUE(name == "nothing" || std::count(leftOutReasons().begin(), leftOutReasons().end(), name)) << name << " is no reason";
  }
}

// In doubt everything runs.
TEST(LeftOutReasons, DoNotHoldInDoubt) {
  Scene night = sceneOf("night");
  const View view = viewOf(night);
  EXPECT_TRUE(holds(planFrame(night, picture(view)), "night"));
  PlanFor asked = picture(view);
  asked.linear = true;
  EXPECT_FALSE(holds(planFrame(night, asked), "night")) << "who reads numbers may look for little light";
  night.output.exposure_ev = 12;
  EXPECT_FALSE(holds(planFrame(night, picture(view)), "night")) << "a long exposure sees it";
  night.output.exposure_ev.reset();
  EXPECT_FALSE(holds(planFrame(night, picture(view)), "night")) << "a meter turns it up";
  const Scene one = sceneOf("one-picture");
  EXPECT_TRUE(planFrame(one).history && planFrame(one, flight(viewOf(one))).history) << "a flight needs it";
  Scene deck = sceneOf("overcast");
  View below = viewOf(deck);
  below.position_m *= (deck.planet.radius_m + 5000) / glm::length(below.position_m);
  EXPECT_FALSE(holds(planFrame(deck, picture(below)), "overcast"));
  std::get<SlabSource>(deck.clouds->sources[0]).extinction_per_m = 0.003;  // 18 straight down
  EXPECT_FALSE(holds(planFrame(deck, picture(viewOf(deck))), "overcast"));
  Scene layered = sceneOf("one-layer");
  LayersSource layers;
  layers.layers = {CloudLayer{}};
  layered.clouds->sources = {layers};
  EXPECT_TRUE(planFrame(layered).oneLayer);
  layers.layers[0].typeHigh = 0.5;
  layered.clouds->sources = {layers};
  EXPECT_FALSE(planFrame(layered).oneLayer) << "the weather's type matters";
}

// Rays of random views, traced: what Sight rules out is never met.
TEST(SightOfViews, RulesOutOnlyWhatNoRayMeets) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  Scene scene = smallEarth();
  const double R = scene.planet.radius_m, top = R + std::max(20'000.0, airTop_m(scene));
  int noShell = 0, noGround = 0, dark = 0;
  for (int i = 0; i < 20'000; ++i) {
    scene.sun->direction_planet = directionTo(180 * unit(random) - 90, 360 * unit(random) - 180);
    const double altitude_m = std::pow(10.0, 8 * unit(random));
    View view = viewAt(180 * unit(random) - 90, 360 * unit(random) - 180, altitude_m, 360 * unit(random), 180 * unit(random) - 90,
                             1 + 140 * unit(random));
    view.orientation = view.orientation * glm::angleAxis(6.3 * unit(random), glm::dvec3(0, 0, 1));  // corners count
    const Sight sight = sightOf(scene, view, 16.0 / 9);
    noShell += !sight.shell, noGround += !sight.ground, dark += !sight.lit;
    const double tanY = std::tan(view.fov_deg * M_PI / 360);
    for (int k = 0; k < 40; ++k) {
      const double x = k < 4 ? 2 * (k % 2) - 1 : 2 * unit(random) - 1, y = k < 4 ? 2 * (k / 2) - 1 : 2 * unit(random) - 1;
      const glm::dvec3 dir = glm::normalize(view.orientation * glm::dvec3(x * tanY * 16 / 9, y * tanY, -1));
      const double b = glm::dot(view.position_m, dir), r = glm::length(view.position_m);
      const double nearest = b < 0 ? std::sqrt(std::max(r * r - b * b, 0.0)) : r;
      ASSERT_TRUE(sight.ground || nearest > R) << i;
      ASSERT_TRUE(sight.shell || nearest > top) << i;
      if (sight.lit || nearest >= top) continue;
      // Where the ray leaves the shell, the ground or not: the sun is below the horizon of even the shell's top, as seen from there.
      const double radius = nearest < R && b < 0 ? R : top, root = std::sqrt(radius * radius - (r * r - b * b));
      const glm::dvec3 p = view.position_m + dir * (nearest < R && b < 0 ? -b - root : -b + root);
      ASSERT_LT(glm::dot(glm::normalize(p), scene.sun->direction_planet), -std::sin(std::acos(R / top))) << i;
    }
  }
  std::printf("of 20000 views: %d past the shell, %d past the ground, %d in the dark\n", noShell, noGround, dark);
  EXPECT_GT(noShell, 1000);
  EXPECT_GT(noGround, 2000);
  EXPECT_GT(dark, 100);
}

class LeftOutTest : public GlTest, public testing::WithParamInterface<std::string> {};

struct Drawn {
  Image8 image;
  std::uint64_t bytes = 0, bricks = 0;
  std::string left;
  std::vector<std::string> passes;
  bool operator==(const Drawn& o) const { return bytes == o.bytes && bricks == o.bricks && left == o.left && passes == o.passes; }
};

Drawn draw(gpu::Context& context, const Scene& scene, const View& view, bool one, std::set<std::string> forced) {
  RenderSettings settings{.width = kWidth, .height = kHeight, .linear = false, .forced = std::move(forced)};
  if (one) settings.onlyView = view;
  const auto renderer = makeRenderer(context, scene, settings);
  if (!renderer) return {};
  renderer->settle(view);
  FrameStats stats = renderer->frame(view, FrameMode::Full);
  for (int i = 0; !one && i < 8; ++i) stats = renderer->frame(view);
  EXPECT_EQ(stats.counters.nanPixels, 0u);
  return {renderer->image(), renderer->memory().used() + renderer->memory().frameTargets(), stats.residency.bricks, stats.leftOut,
          renderer->plan().passes};
}

// As few bricks and as small a field of light as still show a sky with clouds: what is compared is one scene with itself.
TEST_P(LeftOutTest, ForcedBackOnThePictureStays) {
  Scene scene = sceneOf(GetParam());
  const View view = viewOf(scene);
  scene.quality.detail = 6;
  if (scene.atmosphere && GetParam() != "thin-air" && GetParam() != "smooth-air") scene.atmosphere->model = "tables-2d";
  const bool one = holds(planFrame(scene, picture(view)), GetParam());
  const Drawn left = draw(*context, scene, view, one, {}), forced = draw(*context, scene, view, one, {GetParam()});
  // One compiles another variant of a pass, which no number here shows. So does the ground where its picture (make data) is not there.
  const bool variant = GetParam() == "one-layer" || (GetParam() == "no-ground" && !std::filesystem::exists(scene.planet.albedoMap));
  EXPECT_TRUE(variant || !(left == forced)) << "nothing was left out";
  int most = 0;
  for (std::size_t i = 0; i < left.image.rgba.size(); ++i)
    most = std::max(most, std::abs(int(left.image.rgba[i]) - int(forced.image.rgba[i])));
  std::printf("greatest difference %d/255; bytes %llu, forced %llu\n", most, (unsigned long long)left.bytes,
              (unsigned long long)forced.bytes);
  EXPECT_LE(most, 1) << "the promise: unchanged to 1/255";
  const bool black = GetParam() == "night" || GetParam() == "no-sun";
  EXPECT_EQ(contrast(forced.image) < 0.005, black) << "a picture that shows something, unless black is the point";
}
INSTANTIATE_TEST_SUITE_P(Reasons, LeftOutTest, testing::ValuesIn(leftOutReasons()), [](const auto& given) {
  std::string name = given.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

using LeftOutFlight = GlTest;

// A flight that turns away from the planet and back: nothing is streamed or marched meanwhile, and the picture is that of one that
// was never away.
TEST_F(LeftOutFlight, FlightTurnsAwayAndComesBack) {
  Scene scene = quickEarth(8);
  scene.atmosphere->model = "tables-2d";  // a fifth of the time, and air is not the point
  const View before = viewAt(45, 0, 400e3, 0, -40), away = viewAt(45, 0, 400e3, 0, 60), after = viewAt(40, 5, 350e3, 0, -35);
  const RenderSettings settings{.width = kWidth, .height = kHeight, .linear = false};
  const auto renderer = makeRenderer(*context, scene, settings);
  renderer->settle(before);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(renderer->frame(before).leftOut, "");
  for (int i = 0; i < 3; ++i) {
    const FrameStats stats = renderer->frame(away);
    EXPECT_EQ(stats.leftOut, i == 0 ? "looking-away" : stats.leftOut);
    EXPECT_EQ(stats.counters.marchedPixels + stats.bricksGenerated, 0u);
    EXPECT_LT(contrast(renderer->image()), 1e-6) << "black space";
  }
  std::uint64_t holes = 0, atOnce = 0;
  for (int i = 0; i < 30; ++i) {
    const FrameStats stats = renderer->frame(after);
    EXPECT_TRUE(stats.leftOut.empty() || stats.leftOut == "nothing-moves") << stats.leftOut;
    EXPECT_EQ(stats.counters.nanPixels, 0u);
    holes += stats.counters.holes;
  }
  // A cut without being away leads into a tree as cold.
  const auto cut = makeRenderer(*context, scene, settings);
  cut->settle(before);
  for (int i = 0; i < 30; ++i) atOnce += cut->frame(i < 3 ? before : after).counters.holes;
  EXPECT_LE(holes, atOnce + atOnce / 20) << "5 %: three frames more of it";
  renderer->settle(after);
  renderer->preview(after);
  const auto fresh = makeRenderer(*context, scene, settings);
  fresh->settle(after);
  fresh->preview(after);
  const PixelError error = pixelError(renderer->image(), fresh->image());
  EXPECT_GT(contrast(fresh->image()), 0.02);
  EXPECT_LE(error.shareOver1, 0.001) << "of pixels, for 16-bit history and the order of bricks";
}

// A picture is shown again only while nothing moves.
TEST_F(LeftOutFlight, WhatMovesIsDrawn) {
  Scene scene = quickEarth(6);
  scene.atmosphere->model = "tables-2d";
  const auto renderer = makeRenderer(*context, scene, {.width = kWidth, .height = kHeight});
  const View here = viewAt(45, 0, 9000, 0, -12);
  View there = viewAt(45, 0, 9000, 1, -12), darker = here;
  darker.exposure_ev = -2;
  renderer->settle(here);
  FrameStats stats;
  for (int i = 0; i < 20; ++i) stats = renderer->frame(here);
  EXPECT_EQ(stats.leftOut, "nothing-moves");
  const Image8 still = renderer->image();
  EXPECT_EQ(renderer->frame(there).leftOut, "") << "the camera turned";
  EXPECT_GT(pixelError(still, renderer->image()).rmse, 0.001);
  renderer->frame(here);
  EXPECT_EQ(renderer->frame(darker).leftOut, "") << "another exposure";
  for (int i = 0; i < 60; ++i) stats = renderer->frame(here);
  EXPECT_EQ(stats.leftOut, "nothing-moves");
  Quality finer = scene.quality;
  finer.step = 0.1;
  ASSERT_TRUE(renderer->setMarch(finer).ok());
  for (int i = 0; i < 15; ++i) EXPECT_EQ(renderer->frame(here).leftOut, "") << "another step: until every pixel was marched with it";
}

}  // namespace
}  // namespace welkin
