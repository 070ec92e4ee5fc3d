// The scenes of other planets (scripts/planets.py): every view draws, metered, without a NaN; and what each is known for is there.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "gl_fixture.h"
#include "welkin/app/draw.h"
#include "welkin/physics/scene_io.h"
#include "welkin/render/frame_plan.h"

namespace welkin {
namespace {
using Planets = test::GlTest;

constexpr int kWidth = 96, kHeight = 54;

Scene sceneOf(const std::string& name) {
  auto scene = loadScene(std::filesystem::path(WELKIN_SOURCE_DIR) / "scenes" / (name + ".json"));
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().message);
  return scene.ok() ? std::move(*scene) : Scene{};
}

std::unique_ptr<Renderer> rendererOf(gpu::Context& context, const Scene& scene) {
  auto made = Renderer::create(context, scene, {.width = kWidth, .height = kHeight, .timing = false});
  EXPECT_TRUE(made.ok()) << (made.ok() ? "" : made.error().message);
  return made.ok() ? std::move(*made) : nullptr;
}

// Mean radiance of the picture's part around x, y (0..1, from the top left corner), 5 x 5 pixels.
glm::dvec3 lightAt(const ImageF& image, double x, double y) {
  glm::dvec3 sum(0);
  const int cx = std::clamp(int(x * image.width), 2, image.width - 3), cy = std::clamp(int(y * image.height), 2, image.height - 3);
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i)
      for (int c = 0; c < 3; ++c)
        sum[c] += image.rgba[(std::size_t(cy + j) * std::size_t(image.width) + std::size_t(cx + i)) * 4 + std::size_t(c)] / 25.0;
  return sum;
}

// Share of the pixels that are shown neither black nor white.
double shownShare(const Image8& image) {
  int shown = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const auto [least, greatest] = std::minmax({image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]});
    shown += greatest > 8 && least < 250;
  }
  return 4.0 * shown / double(image.rgba.size());
}

TEST_F(Planets, EveryViewDrawsAndIsExposed) {
  for (const char* name : {"clear-earth", "mars", "titan", "moon"}) {
    const Scene scene = sceneOf(name);
    ASSERT_GE(scene.views.size(), 6u);
    const auto renderer = rendererOf(*context, scene);
    ASSERT_NE(renderer, nullptr);
    for (const auto& [view, pose] : scene.views) {
      const auto stats = app::drawConverged(*renderer, pose);
      ASSERT_TRUE(stats.ok());
      EXPECT_EQ(stats->counters.nanPixels, 0u) << name << " " << view;
      // From space a white Lambert ball shows E / pi, and E is 1 at most; haze and glitter show some more, light from nowhere thousands.
      const bool space = glm::length(pose.position_m) > scene.planet.radius_m + 1000;
      for (const float v : renderer->radiance().rgba)
        ASSERT_TRUE(std::isfinite(v) && v >= 0 && (!space || v <= 1.0)) << name << " " << view << " " << v;
      EXPECT_GE(stats->exposure_ev, scene.output.autoExposure.min_ev);
      EXPECT_LE(stats->exposure_ev, scene.output.autoExposure.max_ev);
      EXPECT_GT(shownShare(renderer->image()), 0.1) << name << " " << view << ": at least the planet's disc, a tenth of the picture";
    }
  }
}

// Near the sun the Martian sky is blue, away from it yellow-brown; and the sun itself is not red.
TEST_F(Planets, SunsetOnMarsIsBlue) {
  const Scene scene = sceneOf("mars");
  const auto renderer = rendererOf(*context, scene);
  ASSERT_NE(renderer, nullptr);
  // The view looks 9 degrees over the horizon, the sun stands at 4: a tenth of the picture's height (50 degrees) below its middle.
  ASSERT_TRUE(app::drawConverged(*renderer, scene.views.at("sunset")).ok());
  const ImageF image = renderer->radiance();
  const glm::dvec3 near = lightAt(image, 0.5, 0.5), beside = lightAt(image, 0.04, 0.3);
  std::printf("blue over red: %.2f near the sun, %.2f away from it\n", near.b / near.r, beside.b / beside.r);
  EXPECT_GT(near.b, near.r);
  EXPECT_LT(beside.b, 0.8 * beside.r);
  EXPECT_GT(near.b / near.r, 2 * beside.b / beside.r);
}

// Opposite the sun after sunset: the earth's shadow is dark over the horizon, the belt above it is red.
TEST_F(Planets, BeltOfVenusStandsOverTheShadow) {
  const Scene scene = sceneOf("clear-earth");
  const auto renderer = rendererOf(*context, scene);
  ASSERT_NE(renderer, nullptr);
  ASSERT_TRUE(app::drawConverged(*renderer, scene.views.at("belt-of-venus")).ok());
  const ImageF image = renderer->radiance();  // 40 degrees high, horizon 9 degrees below the middle: at 0.73 of its height
  const glm::dvec3 shadow = lightAt(image, 0.5, 0.68), belt = lightAt(image, 0.5, 0.5);
  EXPECT_GT(belt.r, 1.5 * shadow.r);
  EXPECT_GT(belt.r / belt.b, shadow.r / shadow.b);
}

// An airless ball: no table, no pass for air, and a black sky beside the sun.
TEST_F(Planets, MoonHasNoAir) {
  const Scene scene = sceneOf("moon");
  const FramePlan plan = planFrame(scene);
  EXPECT_EQ(plan.passes, (std::vector<std::string>{"composite", "exposure"}));
  EXPECT_EQ(plan.leftOut.size(), 2u);
  const auto renderer = rendererOf(*context, scene);
  ASSERT_NE(renderer, nullptr);
  EXPECT_FALSE(renderer->memory().byName().contains("sky"));
  ASSERT_TRUE(app::drawConverged(*renderer, scene.views.at("sunset")).ok());
  const ImageF image = renderer->radiance();
  EXPECT_EQ(lightAt(image, 0.5, 0.2), glm::dvec3(0));
  float brightest = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) brightest = std::max(brightest, image.rgba[i + 1]);
  // The disc's radiance E / (pi r^2) is 14,700; a pixel of 58 / 54 degrees has room for five of it; at worst it falls between four pixels.
  EXPECT_GT(brightest, 14700 * 0.19 / 4);
}

TEST_F(Planets, PurplePlanetIsViolet) {
  Scene scene = sceneOf("purple");
  scene.clouds.reset();  // the air alone: in a second
  const auto renderer = rendererOf(*context, scene);
  ASSERT_NE(renderer, nullptr);
  for (const char* view : {"ground", "sunset"}) {
    ASSERT_TRUE(app::drawConverged(*renderer, scene.views.at(view)).ok());
    const glm::dvec3 sky = lightAt(renderer->radiance(), 0.5, 0.4);
    EXPECT_GT(sky.b, sky.r) << view;
    EXPECT_GT(sky.b, 1.2 * sky.g) << view;
  }
}

}  // namespace
}  // namespace welkin
