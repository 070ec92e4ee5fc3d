#include <cmath>
#include <optional>

#include "sky_fixture.h"
#include "welkin/render/composite/composite_pass.h"
#include "welkin/render/sky/sky_tables.h"

namespace welkin {
namespace {

using namespace test;
using Composite = SkyFixture;

// What the cloud passes hand over, one texel for each pixel.
struct CloudLayerTextures {
  gpu::Texture light, aux;
  CloudLayerTextures(gpu::MemoryAccount& account, int width, int height, glm::vec4 lightValue, glm::vec2 auxValue) {
    gpu::TextureSpec spec;
    spec.width = width, spec.height = height, spec.filter = GL_NEAREST, spec.format = GL_RGBA16F;
    light = std::move(gpu::Texture::create(account, "cloud", spec).value());
    spec.format = GL_RG32F;
    aux = std::move(gpu::Texture::create(account, "cloud", spec).value());
    glClearTexImage(light.id(), 0, GL_RGBA, GL_FLOAT, &lightValue);
    glClearTexImage(aux.id(), 0, GL_RG, GL_FLOAT, &auxValue);
    light.bind(WK_CLOUD_LIGHT_UNIT);
    aux.bind(WK_CLOUD_AUX_UNIT);
  }
};

std::vector<glm::vec4> radianceOf(const CompositePass& pass) {
  const auto& spec = pass.radiance().spec();
  std::vector<glm::vec4> pixels(static_cast<std::size_t>(spec.width) * spec.height);
  glGetTextureImage(pass.radiance().id(), 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(pixels.size() * 16), pixels.data());
  return pixels;
}

TEST_F(Composite, CloudLayerIsComposedWithTheAir) {
  const int w = 16, h = 9;
  Scene scene = skyScene(50 * kDegree);
  const auto view = cameraOver(scene, 9000, 0.7, -0.1, 1, 16.0 / 9);
  upload(view);
  auto sky = SkyTables::create(account, scene);
  ASSERT_TRUE(sky.ok());
  sky->updateView(view, scene.sun->direction_planet);
  sky->bind();
  auto clear = CompositePass::create(account, scene, w, h);
  ASSERT_TRUE(clear.ok()) << clear.error().message;
  clear->run(view, 0);
  const auto background = radianceOf(*clear);
  scene.clouds = Clouds{};
  auto pass = CompositePass::create(account, scene, w, h);
  ASSERT_TRUE(pass.ok()) << pass.error().message;
  const auto drawn = [&](glm::vec4 light, glm::vec2 aux) {
    const CloudLayerTextures textures(account, w, h, light, aux);
    pass->run(view, 0);
    return radianceOf(*pass);
  };
  const auto none = drawn({0, 0, 0, 1}, {0, 1}), opaqueNear = drawn({0.25, 0.25, 0.25, 0}, {1, 1}),
             opaqueFar = drawn({0.25, 0.25, 0.25, 0}, {5e4, 1});
  const auto half = drawn({0.125, 0.125, 0.125, 0.5}, {5e4, 1});
  for (std::size_t i = 0; i < none.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      EXPECT_FLOAT_EQ(none[i][c], background[i][c]) << "no cloud: the clear picture";
      EXPECT_NEAR(opaqueNear[i][c], 0.25, 1e-4) << "one metre away: air adds and takes 1e-5 m^-1 at most";
      EXPECT_NEAR(half[i][c], 0.5f * (opaqueFar[i][c] + background[i][c]), 1e-5f) << "a half-open cloud is half of both";
    }
  EXPECT_FLOAT_EQ(half[0].a, 0.5f);
  EXPECT_EQ(nanPixels(), 0u);
  const auto broken = drawn({std::nanf(""), 0, 0, 0.5}, {10, 1});
  EXPECT_EQ(nanPixels(), static_cast<unsigned>(w * h)) << "NaN is counted";
  EXPECT_EQ(broken[3], glm::vec4(1, 0, 1, 0.5f)) << "and shown";
}

// Every combination of what a scene can lack compiles and draws without NaN.
TEST_F(Composite, EveryVariantDraws) {
  AlbedoPicture picture{4, 2, std::vector<std::uint8_t>(32, 128)};
  for (int bits = 0; bits < 16; ++bits) {
    Scene scene = skyScene(50 * kDegree);
    if (bits & 1) scene.clouds = Clouds{};
    if (!(bits & 2)) scene.sun.reset();
    if (!(bits & 4)) scene.atmosphere.reset();
    const auto view = cameraOver(scene, 400e3, 0.7, -0.4, 1, 16.0 / 9);
    upload(view);
    std::optional<SkyTables> sky;
    if (scene.atmosphere) {
      auto made = SkyTables::create(account, scene);
      ASSERT_TRUE(made.ok()) << made.error().message;
      sky.emplace(std::move(*made));
      sky->updateView(view, scene.sun ? scene.sun->direction_planet : glm::dvec3(0, 0, 1));
      sky->bind();
    }
    auto pass = CompositePass::create(account, scene, 16, 9, bits & 8 ? &picture : nullptr);
    ASSERT_TRUE(pass.ok()) << bits << pass.error().message;
    const CloudLayerTextures textures(account, 16, 9, {0.1, 0.1, 0.1, 0.5}, {1e6, 1});
    pass->run(view, 0);
    const auto pixels = radianceOf(*pass);
    EXPECT_EQ(nanPixels(), 0u) << bits;
    EXPECT_EQ(pixels.back().x > 0.01f, (bits & 3) != 0) << "sunlit ground or cloud at the bottom of the picture, " << bits;
  }
}

// The sun's disc without air: its light is the irradiance, whether it fills a hundred pixels or a hundredth of one; its width and its limb.
TEST_F(Composite, SunDiscHasItsLightAndSize) {
  for (const double radius_rad : {0.004675, 0.000487})
    for (const double pixelsPerRadius : {50.0, 10.0, 3.0, 1.0, 0.4, 0.1}) {
      Scene scene = skyScene(60 * kDegree);
      scene.atmosphere.reset();
      scene.sun->irradiance = {1.0, 2.0, 0.5};
      scene.sun->angularRadius_rad = radius_rad;
      const double pixel_rad = radius_rad / pixelsPerRadius;
      const int n = std::clamp(int(0.1 / pixel_rad) * 2 + 1, 5, 129);  // so narrow that all pixels are of one size
      const double fov_rad = 2 * std::atan(pixel_rad * n / 2);
      // At the pole, looking at the sun 30 degrees high, a third of a pixel aside.
      const auto view = cameraOver(scene, 1000, 0.35 * pixel_rad / std::cos(30 * kDegree), 30 * kDegree + 0.2 * pixel_rad, fov_rad, 1);
      upload(view);
      auto pass = CompositePass::create(account, scene, n, n);
      ASSERT_TRUE(pass.ok()) << pass.error().message;
      pass->run(view, 0);
      const auto pixels = radianceOf(*pass);
      glm::dvec3 sum(0);
      int bright = 0;
      const glm::vec4 centre = pixels[std::size_t(n / 2) * n + n / 2];
      for (const glm::vec4& p : pixels) {
        sum += glm::dvec3(p) * pixel_rad * pixel_rad;
        bright += p.g > 0.25f * centre.g;
      }
      // Ripple of the cone between pixels from 0.94 to 1.12, limb darkening within 0.03; ten pixels and more are exact to 1 %.
      const double tolerance = pixelsPerRadius >= 10 ? 0.01 : pixelsPerRadius >= 3 ? 0.03 : 0.12;
      EXPECT_NEAR(sum.r, 1.0, tolerance) << radius_rad << " " << pixelsPerRadius;
      EXPECT_NEAR(sum.g / 2, 1.0, tolerance) << pixelsPerRadius;
      EXPECT_NEAR(sum.b / 0.5, 1.0, tolerance) << pixelsPerRadius;
      if (pixelsPerRadius < 10) continue;
      // The rim in green is 0.38 of the centre, so all of the disc is over a quarter: its area in pixels, but for half a pixel at the rim.
      const double area = kDegree * 180 * pixelsPerRadius * pixelsPerRadius;
      EXPECT_NEAR(bright / area, 1, 1.2 / pixelsPerRadius);
      // Halfway out m = sqrt(3) / 2; the pixel may be half of one aside, and limb darkening is stretched by 1 / (4 n^2).
      const glm::vec4 halfway = pixels[std::size_t(n / 2) * n + n / 2 + std::size_t(std::lround(pixelsPerRadius / 2))];
      EXPECT_NEAR(halfway.b / centre.b, 1 - 0.78 * (1 - std::sqrt(0.75)), 0.6 / pixelsPerRadius);
      EXPECT_GT(halfway.r / centre.r, halfway.b / centre.b) << "the limb is red";
    }
}

// Longitude 0 (+X) in the middle of the picture, north (+Z) up, longitude 90 east (+Y) to the right of the middle.
TEST_F(Composite, AlbedoPictureLiesTheRightWayRound) {
  AlbedoPicture picture{8, 4, std::vector<std::uint8_t>(8 * 4 * 4, 0)};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) {
      const auto texel = picture.rgba.begin() + (y * 8 + x) * 4;
      texel[0] = y < 2 ? 255 : 0;            // red: north
      texel[1] = x >= 2 && x < 6 ? 255 : 0;  // green: within 90 degrees of +X
      texel[2] = x >= 4 ? 255 : 0;           // blue: east
    }
  Scene scene = skyScene(0);
  scene.atmosphere.reset();
  auto pass = CompositePass::create(account, scene, 1, 1, &picture);
  ASSERT_TRUE(pass.ok()) << pass.error().message;
  const double r = scene.planet.radius_m + 1000;
  for (const double east : {45.0, 135.0, -45.0, -135.0}) {  // straight down, one degree of latitude 45
    const double a = east * kDegree, c = std::cos(45 * kDegree);
    const glm::dvec3 up{c * std::cos(a), c * std::sin(a), c}, right{-std::sin(a), std::cos(a), 0}, north = glm::cross(up, right);
    const glm::dvec3 p = up * r;
    const shared::CameraBlock view{{p.x, p.y, p.z, 1000},
                                   {-up.x, -up.y, -up.z, scene.planet.radius_m},
                                   {right.x * 0.1, right.y * 0.1, right.z * 0.1, 20'000},
                                   {north.x * 0.1, north.y * 0.1, north.z * 0.1, r}};
    upload(view);
    pass->run(view, 0);
    const glm::vec4 pixel = radianceOf(*pass)[0];
    EXPECT_GT(pixel.r, 0.1f) << east;
    EXPECT_EQ(pixel.g > 0.1f, std::abs(east) < 90) << east;
    EXPECT_EQ(pixel.b > 0.1f, east > 0) << east;
  }
}

}  // namespace
}  // namespace welkin
