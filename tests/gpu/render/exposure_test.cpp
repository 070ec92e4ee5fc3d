// Metered exposure: the histogram against the CPU's, adaptation in time, and what it does in whole flights.
#include <cmath>
#include <cstdio>
#include <cstring>

#include "flights.h"
#include "random32.h"
#include "welkin/render/exposure/exposure_pass.h"
#include "welkin/render/tone_curve.h"
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/exposure.glsl.h"

namespace welkin {
namespace {
using namespace test;

constexpr double kForEver_s = std::numeric_limits<double>::infinity();

class Exposure : public GlTest {
 protected:
  static Scene meteredScene() {
    Scene scene = bareBall();
    scene.sun = Sun{};
    scene.output.exposure_ev.reset();
    return scene;
  }
  gpu::Texture picture(const std::vector<glm::vec4>& pixels, int width, int height) {
    gpu::TextureSpec spec;
    spec.format = GL_RGBA32F, spec.width = width, spec.height = height, spec.filter = GL_NEAREST;
    auto texture = std::move(gpu::Texture::create(account, "test", spec).value());
    glTextureSubImage2D(texture.id(), 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, pixels.data());
    return texture;
  }
  gpu::Texture plain(float value) { return picture(std::vector<glm::vec4>(20 * 20, glm::vec4(value, value, value, 1)), 20, 20); }
  ExposurePass make(const Scene& scene) {
    auto pass = ExposurePass::create(account, scene);
    EXPECT_TRUE(pass.ok()) << pass.error().message;
    return std::move(*pass);
  }
  static shared::ExposureBlock blockOf(const ExposurePass& pass) {
    shared::ExposureBlock block{};
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    pass.block().download(0, std::as_writable_bytes(std::span(&block, 1)));
    return block;
  }
  gpu::MemoryAccount account{64ull << 20};
};

// The same on the CPU, from the shared functions.
double targetOnCpu(const std::vector<glm::vec4>& pixels, const Scene& scene, double unit) {
  const AutoExposure& s = scene.output.autoExposure;
  std::vector<shared::uint> bins(shared::kExposureBins);
  shared::uint counted = 0;
  for (const glm::vec4& p : pixels) {
    const float y = shared::luminance(glm::vec3(p)) * float(1 / unit);
    if (y > 0) ++bins[shared::exposureBin(y)], ++counted;
  }
  const auto ranks = shared::exposureRanks(counted, float(s.lowPercentile) / 100, float(s.highPercentile) / 100);
  double sum = 0;
  shared::uint before = 0;
  for (shared::uint i = 0; i < shared::kExposureBins; ++i) {
    sum += double(shared::exposureWeight(before, bins[i], ranks)) * shared::exposureBinStops(i);
    before += bins[i];
  }
  return std::log2(middleGrey(scene.output.toneCurve) / (shared::kBaseExposure * unit)) + s.compensation_ev - sum / (ranks.y - ranks.x);
}

// Random light over 40 stops, a third of it black, sizes that are no multiple of a work group.
TEST_F(Exposure, HistogramIsTheCpus) {
  Random32 random(3);
  const int width = 237, height = 61;
  std::vector<glm::vec4> pixels(std::size_t(width) * height, glm::vec4(0, 0, 0, 1));
  std::size_t lit = 0;
  for (auto& p : pixels) {
    if (random() % 3 == 0) continue;
    const float y = std::exp2(float(random() % 40000) / 1000 - 32);
    p = {y, y * float(random() % 100) / 100, y * float(random() % 100) / 100, 0};
    ++lit;
  }
  for (const ToneCurve curve : {ToneCurve::Aces, ToneCurve::Lottes})
    for (const double irradiance : {1.0, 1.3, 2e6}) {
      Scene scene = meteredScene();
      scene.sun->irradiance = {irradiance, irradiance, irradiance};
      scene.output.toneCurve = curve;
      scene.output.autoExposure.compensation_ev = 0.5;
      scene.output.autoExposure.min_ev = -40, scene.output.autoExposure.max_ev = 40;
      ExposurePass pass = make(scene);
      pass.meter(picture(pixels, width, height), kForEver_s);
      const auto block = blockOf(pass);
      EXPECT_EQ(block.metered, lit) << "every pixel but the black ones, in any order of the threads";
      // A sum in float of 256 terms up to 2e5: 256 halves of a unit in the last place relative to at most 28 stops.
      EXPECT_NEAR(block.target_ev, targetOnCpu(pixels, scene, irradiance == 1.3 ? 1.0 : std::exp2(std::floor(std::log2(irradiance)))),
                  1e-3);
      EXPECT_NEAR(block.ev, block.target_ev, 0.5 / shared::kEvSteps + 1e-6) << "the first picture is adapted to fully";
      for (const shared::uint n : block.bins) EXPECT_EQ(n, 0u) << "emptied for the next picture";
    }
}

// An even grey is shown as 0.18 of white, in any unit of light; compensation moves it by stops.
TEST_F(Exposure, PlainPictureIsShownAsMiddleGrey) {
  for (const ToneCurve curve : {ToneCurve::Aces, ToneCurve::Reinhard, ToneCurve::Lottes, ToneCurve::Uchimura})
    for (const float light : {1e-6f, 0.02f, 0.9f}) {
      Scene scene = meteredScene();
      scene.output.toneCurve = curve;
      scene.output.autoExposure.max_ev = 40;
      ExposurePass pass = make(scene);
      pass.meter(plain(light), kForEver_s);
      const auto block = blockOf(pass);
      EXPECT_EQ(block.scale, exposureScale(block.ev)) << "the GPU's scale is the one that a file's number gives";
      const float shown = toned(curve, glm::vec3(light * block.scale)).y;
      // The middle of a bin is at most 0.088 stops off (6 %), the shown EV 0.002 more; display light rises at most by the power 1.6.
      EXPECT_NEAR(shown / 0.18f, 1, 0.11) << kToneCurveNames[std::size_t(curve)] << " " << light;
    }
}

// Small bright things and blackness do not rule: the sun's disc, space around a planet.
TEST_F(Exposure, SunAndSpaceDoNotRule) {
  std::vector<glm::vec4> pixels(40 * 40, glm::vec4(0.1f, 0.1f, 0.1f, 1));
  ExposurePass pass = make(meteredScene());
  pass.meter(picture(pixels, 40, 40), kForEver_s);
  const float before = blockOf(pass).ev;
  for (int i = 0; i < 80; ++i) pixels[std::size_t(i) * 7] = glm::vec4(14500, 14500, 14500, 1);  // 5 %
  ExposurePass sunny = make(meteredScene());
  sunny.meter(picture(pixels, 40, 40), kForEver_s);
  EXPECT_EQ(blockOf(sunny).ev, before);
  for (std::size_t i = 600; i < pixels.size(); ++i) pixels[i] = glm::vec4(0, 0, 0, 1);
  for (int i = 0; i < 80; ++i) pixels[std::size_t(i) * 7] = glm::vec4(0.1f, 0.1f, 0.1f, 1);
  ExposurePass space = make(meteredScene());
  space.meter(picture(pixels, 40, 40), kForEver_s);
  EXPECT_EQ(blockOf(space).ev, before);
}

// A step in brightness by two stops: after one time constant 63 % of the way is gone, whatever the length of a frame.
TEST_F(Exposure, AdaptsWithItsTimeConstants) {
  Scene scene = meteredScene();
  scene.output.autoExposure.adaptToBright_s = 0.5;
  scene.output.autoExposure.adaptToDark_s = 2;
  const gpu::Texture dim = plain(0.05f), bright = plain(0.2f);  // the same place within a bin
  for (const double frame_s : {0.5, 0.1, 1.0 / 60}) {
    ExposurePass pass = make(scene);
    pass.meter(dim, 1e-3);
    const float from = blockOf(pass).adapted_ev;
    const auto after = [&](const gpu::Texture& picture, double seconds) {
      for (int i = 0; i < int(std::lround(seconds / frame_s)); ++i) pass.meter(picture, frame_s);
      return blockOf(pass).adapted_ev;
    };
    // 120 roundings of a float of size 4 at most: 120 * 2.4e-7; 1e-4 is 1/40 of a step of EV.
    EXPECT_NEAR(after(bright, 0.5), from - 2 * (1 - std::exp(-1.0)), 1e-4) << frame_s;
    EXPECT_NEAR(after(bright, 50), from - 2, 1e-4);
    EXPECT_NEAR(after(dim, 2), from - 2 * std::exp(-1.0), 1e-4);
    pass.meter(dim, 0);
    EXPECT_NEAR(blockOf(pass).adapted_ev, from - 2 * std::exp(-1.0), 1e-4) << "time stands still";
    pass.meter(dim, kForEver_s);
    EXPECT_EQ(blockOf(pass).adapted_ev, blockOf(pass).target_ev);
  }
}

TEST_F(Exposure, BlackStaysFiniteAndLimitsHold) {
  Scene scene = meteredScene();
  scene.output.autoExposure.min_ev = 1, scene.output.autoExposure.max_ev = 3;
  ExposurePass pass = make(scene);
  pass.meter(plain(0), kForEver_s);
  EXPECT_EQ(blockOf(pass).metered, 0u);
  EXPECT_EQ(blockOf(pass).ev, 1) << "0 EV, within the limits";
  EXPECT_EQ(blockOf(pass).scale, exposureScale(1));
  pass.meter(plain(1e-12f), 0.01);
  EXPECT_EQ(blockOf(pass).ev, 3) << "the first light is adapted to fully";
  pass.meter(plain(0), kForEver_s);
  EXPECT_EQ(blockOf(pass).ev, 3) << "in blackness it stays where it was";
  pass.meter(plain(1e9f), kForEver_s);
  EXPECT_EQ(blockOf(pass).ev, 1);
  pass.meter(picture(std::vector<glm::vec4>(400, glm::vec4(shared::kNanPaint, 1)), 20, 20), kForEver_s);
  EXPECT_EQ(blockOf(pass).metered, 0u) << "what a pass painted for a NaN is no light";
}

// ---- whole pictures ----

Scene meteredEarth() {
  Scene scene = quickEarth(4);
  scene.output.exposure_ev.reset();
  return scene;
}

TEST_F(Exposure, MeteredPictureComesBackEqualFromItsNumber) {
  const View view = sideways(0, 0);
  const auto metered = makeRenderer(*context, meteredEarth());
  metered->settle(view);
  const double ev = metered->frame(view, FrameMode::Full).exposure_ev;
  const Image8 picture = metered->image();
  EXPECT_GT(contrast(picture), 0.05);
  EXPECT_NE(ev, 0);
  EXPECT_EQ(ev * shared::kEvSteps, std::round(ev * shared::kEvSteps));
  View numbered = view;
  numbered.exposure_ev = ev;
  EXPECT_EQ(metered->frame(numbered, FrameMode::Full).exposure_ev, ev);
  EXPECT_EQ(metered->image().rgba, picture.rgba) << "the same scene, the view has the number";
  Scene scene = meteredEarth();
  scene.output.exposure_ev = ev;
  const auto fixed = makeRenderer(*context, scene);
  fixed->settle(view);
  EXPECT_EQ(fixed->frame(view, FrameMode::Full).exposure_ev, ev);
  EXPECT_EQ(fixed->image().rgba, picture.rgba) << "a scene with the number: tone-mapped in the composite pass";
}

// Radiance is linear in the sun's irradiance, so a unit that is 1024 times smaller asks for ten stops less and shows the same picture: all
// steps on the way are divisions by powers of two, or rounded relative to the value.
TEST_F(Exposure, UnitOfLightChangesNoPicture) {
  Scene scene = smallEarth();
  scene.clouds.reset();
  scene.output.exposure_ev.reset();
  const View view = viewAt(45, 0, 9000, 0, -12);
  const auto drawn = [&](double unit) {
    scene.sun->irradiance = {1.474 * unit, 1.850 * unit, 1.912 * unit};
    const auto renderer = makeRenderer(*context, scene);
    const double ev = renderer->frame(view, FrameMode::Full).exposure_ev;
    return std::pair{ev, renderer->image()};
  };
  const auto [ev, picture] = drawn(1);
  const auto [large_ev, large] = drawn(1024);
  EXPECT_EQ(large_ev, ev - 10);
  EXPECT_EQ(large.rgba, picture.rgba);
  EXPECT_GT(contrast(picture), 0.05);
}

TEST_F(Exposure, FlightAdaptsAndIsTheSameTwice) {
  const auto fly = [&](std::uint32_t jitter, std::vector<double>& evs) {
    const auto renderer =
        makeRenderer(*context, meteredEarth(), {.width = 48, .height = 27, .bricksPerFrame = 64, .workerJitterSeed = jitter});
    std::vector<std::uint8_t> pictures;
    for (int i = 0; i < 12; ++i) {
      evs.push_back(renderer->frame(viewAt(45, 0, 9000, 0, i < 6 ? -30 : 40), FrameMode::Reprojected, 1.0 / 30).exposure_ev);
      const Image8 image = renderer->image();
      pictures.insert(pictures.end(), image.rgba.begin(), image.rgba.end());
    }
    return pictures;
  };
  std::vector<double> a, b;
  EXPECT_EQ(fly(0, a), fly(5, b));
  EXPECT_EQ(a, b);
  EXPECT_GT(std::abs(a[11] - a[5]), 0.02) << "from the clouds below to the sky above";
  EXPECT_LT(std::abs(a[6] - a[5]), std::abs(a[11] - a[5])) << "gradually";
}

// Comparing pictures does not move what the flight sees.
TEST_F(Exposure, PreviewKeepsTheExposure) {
  const auto renderer = makeRenderer(*context, meteredEarth(), {.width = 48, .height = 27});
  const View down = viewAt(45, 0, 9000, 0, -30), up = viewAt(45, 0, 9000, 0, 40);
  renderer->settle(down);
  const double ev = renderer->frame(down).exposure_ev;
  renderer->preview(up);
  EXPECT_EQ(renderer->frame(down, FrameMode::Reprojected, 0).exposure_ev, ev);
  const auto fresh = makeRenderer(*context, meteredEarth(), {.width = 48, .height = 27});
  fresh->settle(down);
  fresh->preview(down);
  EXPECT_GT(contrast(fresh->image()), 0.02) << "without a frame before it, it meters itself";
}

TEST_F(Exposure, IsLeftOutWithAReason) {
  Scene scene = meteredScene();
  const auto memory = [&] {
    const auto renderer = makeRenderer(*context, scene, {.width = 16, .height = 16});
    renderer->frame(viewAt(45, 0, 9000, 0, -30));
    return renderer->memory().byName();
  };
  const auto reason = [&] {
    for (const auto& left : planFrame(scene).leftOut)
      if (left.what.find("exposure") != std::string::npos) return left.reason;
    return std::string();
  };
  EXPECT_TRUE(planFrame(scene).metered);
  EXPECT_EQ(memory().at("exposure"), sizeof(shared::ExposureBlock)) << "charged to the budget";
  EXPECT_EQ(reason(), "");
  scene.output.exposure_ev = 0;
  EXPECT_FALSE(planFrame(scene).metered);
  EXPECT_FALSE(memory().contains("exposure"));
  EXPECT_NE(reason().find("number"), std::string::npos);
  scene.output.exposure_ev.reset();
  scene.sun.reset();
  EXPECT_FALSE(memory().contains("exposure"));
  EXPECT_NE(reason().find("no sun"), std::string::npos);
}

}  // namespace
}  // namespace welkin
