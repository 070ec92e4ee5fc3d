// Debug views tell what the renderer did, and do not disturb it.
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include "flights.h"
#include "welkin/shared/debug.glsl.h"

namespace welkin {
namespace {
using namespace test;
using DebugViews = GlTest;

constexpr int kWidth = 128, kHeight = 72;
constexpr std::size_t kPixels = std::size_t(kWidth) * kHeight;

Scene earth() {
  Scene scene = quickEarth();
  scene.output.exposure_ev = 0;
  scene.quality.spread = 0;  // every pixel of a whole picture is marched
  return scene;
}

// A layer of one extinction around the globe, and a camera that looks down onto it along the sun's rays.
Scene slab(double extinction_per_m) {
  Scene scene = earth();
  scene.clouds->sources = {SlabSource{1000, 5000, extinction_per_m}};
  return scene;
}
View ontoTheSlab(double fov_deg = 20) { return viewAt(20, -30, 9000, 0, -90, fov_deg); }

std::vector<float> valuesOf(Renderer& renderer, DebugView view, const View& from) {
  EXPECT_TRUE(renderer.setDebugView(view).ok());
  renderer.preview(from);
  return renderer.debugValues();
}

double mean(const std::vector<float>& values, std::size_t begin, std::size_t end) {
  double sum = 0, n = 0;
  for (std::size_t i = begin; i < end; ++i)
    if (values[i] >= 0) sum += double(values[i]), ++n;
  return sum / n;
}

TEST(DebugNumbersOfValues, CountWhatHasOne) {
  const float nan = std::nanf("");
  const DebugNumbers n = debugNumbers(DebugView::Density, {1, 3, -1, nan});
  EXPECT_EQ(n.pixels, 2u);
  EXPECT_EQ(n.without, 1u);
  EXPECT_EQ(n.nan, 1u) << "told, and in no mean";
  EXPECT_TRUE(n.minimum == 1 && n.mean == 2 && n.maximum == 3);
  const DebugNumbers kinds = debugNumbers(DebugView::History, {0, 4, 4, 400});
  EXPECT_EQ(kinds.kinds, (std::vector<std::uint64_t>{1, 0, 0, 0, 2}));
  EXPECT_EQ(debugNumbers(DebugView::Light, {}).mean, 0);
  EXPECT_EQ(debugText(debugNumbers(DebugView::Light, {0.25f, 0.75f, -1})), "25 % to 75 %, mean 50 %, 1 pixels without");
  EXPECT_EQ(debugText(debugNumbers(DebugView::Nan, {0, 0, 2})), "right: 2, not a number or infinite: 0, negative: 1");
}

TEST_F(DebugViews, StepsSumToTheCounterOfSamples) {
  const auto renderer = makeRenderer(*context, earth());
  ASSERT_NE(renderer, nullptr);
  renderer->settle(sideways(0, 0));
  for (const Integrator integrator : {Integrator::ExponentialLinear, Integrator::Adaptive}) {
    Quality quality = renderer->scene().quality;
    quality.integrator = integrator;
    ASSERT_TRUE(renderer->setDebugView(DebugView::Steps).ok());
    ASSERT_TRUE(renderer->setMarch(quality).ok());
    const FrameCounters counters = renderer->preview(sideways(0, 0));
    const auto values = renderer->debugValues();
    double sum = 0;
    for (const float v : values) sum += std::max(double(v), 0.0);
    EXPECT_EQ(counters.marchedPixels, kPixels) << "the debug view counts nothing";
    EXPECT_GT(counters.samples, kPixels);
    EXPECT_EQ(std::uint64_t(sum), counters.samples);
  }
}

TEST_F(DebugViews, DetailIsOfTheTreeAndCoarserFarAway) {
  const auto renderer = makeRenderer(*context, earth());
  ASSERT_NE(renderer, nullptr);
  renderer->settle(sideways(0, 0));
  const auto values = valuesOf(*renderer, DebugView::Detail, sideways(0, 0));
  const DebugNumbers n = debugNumbers(DebugView::Detail, values);
  EXPECT_GT(n.pixels, kPixels / 4);
  EXPECT_LE(n.maximum, renderer->scene().quality.depth);
  EXPECT_GE(n.maximum - n.minimum, 2) << "several levels";
  const double near = mean(values, kPixels * 3 / 4, kPixels), far = mean(values, kPixels * 2 / 8, kPixels * 3 / 8);
  std::printf("levels %.0f to %.0f; near %.2f, below the horizon %.2f\n", n.minimum, n.maximum, near, far);
  EXPECT_GT(near, far + 1) << "two kilometres against a hundred";
}

TEST_F(DebugViews, DensityOfASlabIsItsExtinction) {
  for (const double extinction_per_m : {0.0003, 0.001}) {
    const auto renderer = makeRenderer(*context, slab(extinction_per_m));
    ASSERT_NE(renderer, nullptr);
    renderer->settle(ontoTheSlab());
    const DebugNumbers n = debugNumbers(DebugView::Density, valuesOf(*renderer, DebugView::Density, ontoTheSlab()));
    EXPECT_EQ(n.pixels, kPixels);
    EXPECT_NEAR(n.minimum, extinction_per_m, 1e-4 * extinction_per_m) << "16 bits of the source's greatest: 1.5e-5";
    EXPECT_NEAR(n.maximum, extinction_per_m, 1e-4 * extinction_per_m);
    const DebugNumbers full = debugNumbers(DebugView::Occupancy, valuesOf(*renderer, DebugView::Occupancy, ontoTheSlab()));
    EXPECT_GT(full.minimum, 0.99) << "the band is the slab, and the slab is full";
  }
}

// Sun and eye on one line over a thick slab: what is seen at depth tau has the weight exp(-tau), and exp(-tau) of the sun. The mean is
// the integral of exp(-2 tau) over that of exp(-tau): 1/2.
TEST_F(DebugViews, LightOfASlabIsHalf) {
  Scene scene = slab(0.003);
  scene.quality.detail = 30;
  const auto renderer = makeRenderer(*context, scene);
  ASSERT_NE(renderer, nullptr);
  renderer->settle(ontoTheSlab(4));
  const DebugNumbers n = debugNumbers(DebugView::Light, valuesOf(*renderer, DebugView::Light, ontoTheSlab(4)));
  std::printf("light %.4f to %.4f, mean %.4f\n", n.minimum, n.maximum, n.mean);
  EXPECT_EQ(n.pixels, kPixels);
  EXPECT_NEAR(n.mean, 0.5, 0.03) << "voxels of 20 m have an optical depth of 0.06, and the slab's faces are off by half of one";
}

TEST_F(DebugViews, LightOnClearGroundIsAll) {
  const auto renderer = makeRenderer(*context, slab(0));
  ASSERT_NE(renderer, nullptr);
  renderer->settle(ontoTheSlab());
  const DebugNumbers n = debugNumbers(DebugView::Light, valuesOf(*renderer, DebugView::Light, ontoTheSlab()));
  EXPECT_EQ(n.pixels, kPixels);
  EXPECT_EQ(n.minimum, 1);
  const DebugNumbers none = debugNumbers(DebugView::Density, valuesOf(*renderer, DebugView::Density, ontoTheSlab()));
  EXPECT_EQ(none.without, kPixels);
}

TEST_F(DebugViews, HistoryIsWhatTheFrameCounted) {
  const auto renderer = makeRenderer(*context, earth(), {.width = kWidth, .height = kHeight, .forced = {"nothing-moves"}});
  ASSERT_NE(renderer, nullptr);
  ASSERT_TRUE(renderer->setDebugView(DebugView::History).ok());
  renderer->settle(sideways(0, 0));
  const auto kindsOf = [&] { return debugNumbers(DebugView::History, renderer->debugValues()).kinds; };
  renderer->frame(sideways(0, 0));
  EXPECT_EQ(kindsOf()[shared::kHistoryTurn], kPixels) << "the first picture is marched as a whole";
  for (int i = 0; i < 20; ++i) renderer->frame(sideways(0, 0));
  const auto rest = kindsOf();
  EXPECT_EQ(rest[shared::kHistoryTurn], kPixels / 16);
  EXPECT_EQ(rest[shared::kHistoryRejected], 0u);
  EXPECT_EQ(rest[shared::kHistoryYoung], kPixels / 4) << "four turns";
  EXPECT_EQ(rest[shared::kHistoryMiddle], kPixels * 6 / 16);
  const FrameStats moved = renderer->frame(sideways(1, 600));
  EXPECT_GT(moved.counters.rejectedPixels, kPixels / 50) << "600 m aside something comes into sight";
  EXPECT_EQ(kindsOf()[shared::kHistoryRejected], moved.counters.rejectedPixels);
}

TEST_F(DebugViews, AirIsThePictureWithoutClouds) {
  const View view = viewAt(45, 0, 9000, 0, -12);
  const auto renderer = makeRenderer(*context, earth());
  Scene without = earth();
  without.clouds.reset();
  const auto clear = makeRenderer(*context, without);
  ASSERT_TRUE(renderer && clear);
  renderer->settle(view);
  ASSERT_TRUE(renderer->setDebugView(DebugView::Air).ok());
  renderer->frame(view);
  clear->frame(view);
  EXPECT_GT(contrast(clear->image()), 0.01);
  EXPECT_EQ(renderer->image().rgba, clear->image().rgba);
}

TEST_F(DebugViews, NanShowsWhatWasPutIn) {
  const View view = viewAt(45, 0, 9000, 0, -12);
  const auto renderer = makeRenderer(*context, earth());
  ASSERT_NE(renderer, nullptr);
  renderer->settle(view);
  ASSERT_TRUE(renderer->setDebugView(DebugView::Nan).ok());
  renderer->preview(view);
  EXPECT_EQ(debugNumbers(DebugView::Nan, renderer->debugValues()).kinds[0], kPixels) << "a sound picture";
  const float nan = std::nanf(""), inf = std::numeric_limits<float>::infinity();
  std::vector<shared::CloudWeights> clouds(kPixels, {0.1f, 0.1f, 0.1f, 0.5f, 1e4f});
  std::vector<float> expected(kPixels, 0);
  const auto put = [&](std::size_t pixel, const shared::CloudWeights& weights, float kind) {
    clouds[pixel] = weights, expected[pixel] = kind;
  };
  put(0, {nan, 0.1f, 0.1f, 0.5f, 1e4f}, 1);
  put(777, {0.1f, 0.1f, 0.1f, nan, 1e4f}, 1);
  put(4000, {0.1f, 0.1f, 0.1f, 0.5f, nan}, 1);
  put(5001, {-inf, 0.1f, 0.1f, 0.5f, 1e4f}, 1);
  put(kPixels - 1, {-1e3f, 0.1f, 0.1f, 0.5f, 1e4f}, 2);
  ASSERT_TRUE(renderer->drawWith(view, clouds).ok());
  const auto values = renderer->debugValues();
  for (std::size_t i = 0; i < kPixels; ++i) EXPECT_EQ(values[i], expected[i]) << "pixel " << i;
  const Image8 image = renderer->image();
  for (std::size_t i = 0; i < kPixels; ++i) {
    const std::uint8_t* p = &image.rgba[4 * i];
    if (expected[i] > 0)
      ASSERT_TRUE(p[0] == 255 && p[1] == 0 && p[2] == 255) << i;
    else
      ASSERT_TRUE(p[0] == p[1] && p[1] == p[2]) << i << " is grey";
  }
}

// A flight with views switched on and off is the flight without, to the byte, and leaves no memory behind.
TEST_F(DebugViews, PictureIsTheSameAfterwards) {
  const auto plain = makeRenderer(*context, earth()), watched = makeRenderer(*context, earth());
  ASSERT_TRUE(plain && watched);
  plain->settle(sideways(0, 0));
  watched->settle(sideways(0, 0));
  const auto targets = watched->memory().frameTargets(), used = watched->memory().used();
  for (int i = 0; i < 18; ++i) {
    const auto view = DebugView(i % int(kDebugViewNames.size()));
    ASSERT_TRUE(watched->setDebugView(view).ok());
    EXPECT_EQ(watched->debugView(), view);
    const FrameStats a = plain->frame(sideways(i, 60)), b = watched->frame(sideways(i, 60));
    EXPECT_EQ(a.counters.samples, b.counters.samples);
    EXPECT_EQ(a.counters.nanPixels, b.counters.nanPixels);
    EXPECT_EQ(plain->image().rgba == watched->image().rgba, view == DebugView::None) << kDebugViewNames[std::size_t(view)];
    ASSERT_TRUE(watched->setDebugView(DebugView::None).ok());
    EXPECT_EQ(plain->image().rgba, watched->image().rgba) << "at once, without a new frame";
  }
  EXPECT_EQ(watched->memory().frameTargets(), targets);
  EXPECT_EQ(watched->memory().used(), used);
}

// A legend has the picture's colours, in any size.
TEST_F(DebugViews, ColoursAreThoseOfTheLegend) {
  const auto renderer = makeRenderer(*context, earth());
  ASSERT_NE(renderer, nullptr);
  renderer->settle(sideways(0, 0));
  for (const DebugView view :
       {DebugView::Steps, DebugView::Detail, DebugView::Occupancy, DebugView::History, DebugView::Density, DebugView::Light}) {
    ASSERT_TRUE(renderer->setDebugView(view).ok());
    ASSERT_TRUE(renderer->resize(view == DebugView::Light ? 64 : 65, 37).ok());
    renderer->frame(sideways(0, 0));
    const auto values = renderer->debugValues();
    const Image8 image = renderer->image();
    ASSERT_EQ(4 * values.size(), image.rgba.size());
    int most = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const glm::vec3 colour = shared::debugColour(unsigned(view), values[i]);
      for (int c = 0; c < 3; ++c) most = std::max(most, int(std::abs(255 * colour[c] - float(image.rgba[4 * i + std::size_t(c)])) + 0.5f));
    }
    EXPECT_LE(most, 1) << kDebugViewNames[std::size_t(view)] << ": rounding, and pow() of two compilers";
  }
}

// Where there is nothing to watch, a view shows none, and where only the background is drawn, the background.
TEST_F(DebugViews, NothingIsShownOfNothing) {
  Scene scene = earth();
  scene.clouds.reset();
  const auto clear = makeRenderer(*context, scene);
  ASSERT_NE(clear, nullptr);
  for (const DebugView view : {DebugView::Steps, DebugView::History, DebugView::Light}) {
    ASSERT_TRUE(clear->setDebugView(view).ok());
    clear->frame(sideways(0, 0));
    EXPECT_EQ(debugNumbers(view, clear->debugValues()).without, kPixels);
  }
  const auto renderer = makeRenderer(*context, earth());
  ASSERT_TRUE(renderer->setDebugView(DebugView::Steps).ok());
  EXPECT_EQ(renderer->frame(viewAt(45, 0, 400e3, 0, 60)).leftOut, "looking-away");
  EXPECT_TRUE(renderer->debugValues().empty());
  EXPECT_LT(contrast(renderer->image()), 1e-6) << "black space";
}

}  // namespace
}  // namespace welkin
