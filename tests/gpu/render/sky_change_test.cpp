// Air that changes while it is drawn, fields kept on disk, which model is taken, and a camera below the ground.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "gl_fixture.h"
#include "sky_scene.h"
#include "welkin/render/renderer.h"
#include "welkin/render/sky/sky_field.h"
#include "welkin/render/sky/sky_tables.h"

namespace welkin {
namespace {

using namespace test;
using SkyChange = GlTest;

View eye() {
  View view;
  view.position_m = {0, 0, 6'360'000 + 500};
  const glm::dvec3 forward{1, 0, 0.1};
  view.orientation = glm::quatLookAt(glm::normalize(forward), glm::dvec3(0, 0, 1));
  return view;
}

std::vector<float> draw(Renderer& renderer) {
  renderer.frame(eye());
  return renderer.radiance().rgba;
}

RenderSettings small() {
  RenderSettings settings;
  settings.width = 32, settings.height = 18;
  settings.timing = false;
  return settings;
}

Scene hazy() {
  Scene scene = skyScene(80 * kDegree);
  for (double& s : scene.atmosphere->layers[1].scattering_per_m) s *= 5;
  scene.planet.albedo = {0.5, 0.3, 0.1};
  scene.sun->irradiance = {2, 1, 1};
  return scene;
}

// On the ground, below it, even in the planet's centre: as from the ground, never from inside.
TEST_F(SkyChange, CameraBelowTheGroundStandsOnIt) {
  auto renderer = Renderer::create(*context, skyScene(60 * kDegree), small());
  ASSERT_TRUE(renderer.ok());
  View view = eye();
  const auto from = [&](double altitude_m) {
    view.position_m = {0, 0, 6'360'000 + altitude_m};
    (*renderer)->frame(view);
    return (*renderer)->radiance().rgba;
  };
  const auto ground = from(0.001);
  for (const double altitude : {0.0, -1e-9, -10.0, -6'360'000.0}) EXPECT_EQ(from(altitude), ground) << altitude;
  EXPECT_NE(from(2000), ground);
}

// The new light is the one of a fresh start, and on the way there the old one is drawn, a slice of work a frame.
TEST_F(SkyChange, RecomputesOverFrames) {
  auto renderer = Renderer::create(*context, skyScene(80 * kDegree), small());
  ASSERT_TRUE(renderer.ok()) << renderer.error().message;
  auto fresh = Renderer::create(*context, hazy(), small());
  ASSERT_TRUE(fresh.ok());
  const auto before = draw(**renderer), wanted = draw(**fresh);
  ASSERT_NE(before, wanted);
  ASSERT_TRUE((*renderer)->setAir(hazy(), Renderer::AirChange::Recompute).ok());
  double last = -1;
  int frames = 0;
  std::vector<float> now;
  for (;; ++frames) {
    const FrameStats stats = (*renderer)->frame(eye());
    now = (*renderer)->radiance().rgba;
    if (stats.skyProgress == 1) break;
    EXPECT_GT(stats.skyProgress, last) << "every frame does some of it";
    last = stats.skyProgress;
    EXPECT_EQ(now, before) << "the old light until the new one is there";
    ASSERT_LT(frames, 22 * 40) << "one altitude a frame, 40 orders at most";
  }
  EXPECT_GT(frames, 3) << "no frame waits for all of it";
  EXPECT_EQ(now, wanted);
}

TEST_F(SkyChange, KeepsTheOldDiffuseLight) {
  auto renderer = Renderer::create(*context, skyScene(80 * kDegree), small());
  ASSERT_TRUE(renderer.ok());
  const auto before = draw(**renderer);
  ASSERT_TRUE((*renderer)->setAir(hazy(), Renderer::AirChange::Keep).ok());
  const FrameStats stats = (*renderer)->frame(eye());
  EXPECT_EQ(stats.skyProgress, 1);
  EXPECT_EQ(stats.counters.nanPixels, 0u);
  EXPECT_NE((*renderer)->radiance().rgba, before);
  Scene other = hazy();
  other.atmosphere->model = "tables-2d";
  const auto kept = (*renderer)->radiance().rgba;
  const auto refused = (*renderer)->setAir(other, Renderer::AirChange::Keep);
  ASSERT_FALSE(refused.ok()) << "a field of another model does not fit";
  EXPECT_EQ(draw(**renderer), kept);
  other.atmosphere.reset();
  EXPECT_FALSE((*renderer)->setAir(other, Renderer::AirChange::Recompute).ok());
}

TEST_F(SkyChange, FieldsAreKeptOnDisk) {
  const auto folder = std::filesystem::temp_directory_path() / ("welkin-cache-" + std::to_string(::getpid()));
  ::setenv("WELKIN_CACHE", folder.c_str(), 1);
  gpu::MemoryAccount account(64 << 20);
  Scene scene = skyScene(1);
  scene.atmosphere->model = "tables-2d";
  const auto texels = [](const SkyTables& sky) {
    const auto& spec = sky.field().irradiance().spec();
    std::vector<float> out(std::size_t(spec.width) * spec.height * 4);
    glGetTextureImage(sky.field().irradiance().id(), 0, GL_RGBA, GL_FLOAT, GLsizei(out.size() * 4), out.data());
    return out;
  };
  auto made = SkyTables::create(account, scene);
  ASSERT_TRUE(made.ok());
  EXPECT_FALSE(made->field().kept());
  auto again = SkyTables::create(account, scene);
  EXPECT_TRUE(again->field().kept());
  EXPECT_EQ(texels(*made), texels(*again));
  scene.sun->irradiance = {3, 2, 1};
  EXPECT_TRUE(SkyTables::create(account, scene)->field().kept()) << "fields are per unit of irradiance";
  scene.planet.albedo = {0.5, 0.5, 0.5};
  EXPECT_FALSE(SkyTables::create(account, scene)->field().kept());
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {  // one bit of a file flips
    std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(-5, std::ios::end);
    file.put('x');
  }
  auto broken = SkyTables::create(account, scene);
  ASSERT_TRUE(broken.ok());
  EXPECT_FALSE(broken->field().kept()) << "a broken file is made anew";
  std::filesystem::remove_all(folder);
  ::setenv("WELKIN_CACHE", "", 1);
}

TEST_F(SkyChange, ModelsArePicked) {
  Scene scene = skyScene(1);
  EXPECT_EQ(skyModel(scene)->name, "tables-4d");
  EXPECT_GT(skyModel(scene)->zonal, 2);
  scene.atmosphere->layers.resize(1);
  EXPECT_EQ(skyModel(scene)->zonal, 2) << "Rayleigh's phase function has no more";
  for (double& s : scene.atmosphere->layers[0].scattering_per_m) s *= 1e-5;
  EXPECT_EQ(skyModel(scene)->name, "march") << "too thin for more";
  EXPECT_EQ(planFrame(scene).skyModel, "march");
  scene.atmosphere->model = "tables-2d";
  EXPECT_EQ(skyModel(scene)->name, "tables-2d");
  scene.atmosphere->model = "none of them";
  EXPECT_FALSE(skyModel(scene).ok());
}

}  // namespace
}  // namespace welkin
