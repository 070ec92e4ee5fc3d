// Pixels between marched ones that look alike: what is left out, and how far the picture may be from the march of every pixel.
#include <cmath>

#include "gl_fixture.h"
#include "small_earth.h"
#include "welkin/measure/image_compare.h"
#include "welkin/render/renderer.h"

namespace welkin {
namespace {
using namespace test;

class Spread : public GlTest {
 protected:
  // A size that 4 does not divide: the last rows and columns have no neighbour beyond them.
  static constexpr int kWidth = 95, kHeight = 54;
  const View view = viewAt(45, 0, 9000, 0, -12);

  std::unique_ptr<Renderer> rendererOf(Scene scene, bool reprojection = false) {
    scene.quality.detail = 8;  // settles in a second
    RenderSettings settings{.width = kWidth, .height = kHeight, .timing = false};
    settings.reprojection = reprojection;
    auto made = Renderer::create(*context, scene, settings);
    EXPECT_TRUE(made.ok());
    if (!made.ok()) return nullptr;
    (*made)->settle(view);
    return std::move(*made);
  }
  struct Picture {
    ImageF radiance;
    FrameCounters met;
  };
  Picture draw(Renderer& renderer, double spread) {
    Quality q = renderer.scene().quality;
    q.spread = spread;
    EXPECT_TRUE(renderer.setMarch(q).ok());
    const FrameCounters met = renderer.preview(view);
    return {renderer.radiance(), met};
  }
  double rmse_255(const Picture& a, const Picture& b) {
    const auto error = measure::compareShown(a.radiance, b.radiance, ToneCurve::Aces, 0);
    EXPECT_TRUE(error.ok());
    return error.ok() ? error->rmse_255 : 255;
  }
};

TEST_F(Spread, LeavesOutRaysAndStaysNear) {
  const auto renderer = rendererOf(smallEarth());
  ASSERT_NE(renderer, nullptr);
  const Picture whole = draw(*renderer, 0);
  EXPECT_EQ(whole.met.marchedPixels, kWidth * kHeight);
  double lastError = 0;
  std::uint64_t lastRays = whole.met.marchedPixels + 1;
  for (const double spread : {1e-6, 5.0, 30.0, 255.0}) {
    const Picture some = draw(*renderer, spread);
    const double error = rmse_255(whole, some);
    std::printf("spread %g: %.0f %% of the rays, RMSE %.2f of 255\n", spread, 100.0 * double(some.met.marchedPixels) / (kWidth * kHeight), error);
    EXPECT_LT(some.met.marchedPixels, lastRays) << spread;
    EXPECT_GE(error, lastError) << spread;
    EXPECT_EQ(some.met.nanPixels, 0);
    // Most pixels lie far closer to the mean of their neighbours than these are apart: the RMSE is a twentieth to a tenth of the spread here.
    if (spread >= 5 && spread < 255) {
      EXPECT_LT(error, 0.2 * spread);
    }
    lastError = error, lastRays = some.met.marchedPixels;
  }
  // Nothing is unlike enough: one in 16, and the last rows and columns, which have no neighbour beyond them.
  EXPECT_LT(lastRays, kWidth * kHeight / 8);
}

TEST_F(Spread, PicturesAreRepeatable) {
  const auto renderer = rendererOf(smallEarth());
  ASSERT_NE(renderer, nullptr);
  const Picture first = draw(*renderer, 12), again = draw(*renderer, 12);
  EXPECT_EQ(first.radiance.rgba, again.radiance.rgba);  // the list's order is the machine's; its pixels are not
  EXPECT_EQ(first.met.marchedPixels, again.met.marchedPixels);
}

// Where thin cloud lies beside thick, the pixels between are marched. 12 of 255 is 0.09 of opacity; twice where both turns interpolate.
TEST_F(Spread, EdgesAreMarched) {
  const auto renderer = rendererOf(smallEarth());
  ASSERT_NE(renderer, nullptr);
  const Picture whole = draw(*renderer, 0), some = draw(*renderer, 12);
  int edges = 0, wrong = 0;
  for (int y = 4; y < kHeight - 4; ++y)
    for (int x = 4; x < kWidth - 4; ++x) {
      const auto alpha = [&](const Picture& p, int i, int j) { return p.radiance.rgba[4 * std::size_t((y + j) * kWidth + x + i) + 3]; };
      // Four pixels to the right there is much more: among the marched ones are some of each side.
      if (alpha(whole, 4, 0) - alpha(whole, 0, 0) < 0.4) continue;
      ++edges;
      for (int i = 0; i <= 4; ++i) wrong += std::abs(alpha(whole, i, 0) - alpha(some, i, 0)) > 0.2 ? 1 : 0;
    }
  EXPECT_GT(edges, 10);
  std::printf("%d edges, %d pixels off\n", edges, wrong);
  EXPECT_EQ(wrong, 0);  // six, where only the two neighbours along an edge of the lattice are asked
}

TEST_F(Spread, FirstFrameOfAFlightIsSpreadAndTheRestRefinesIt) {
  Scene scene = smallEarth();
  const auto renderer = rendererOf(scene, true);
  ASSERT_NE(renderer, nullptr);
  Quality q = renderer->scene().quality;
  renderer->preview(view);
  const Picture whole{renderer->radiance(), {}};
  q.spread = 40;
  ASSERT_TRUE(renderer->setMarch(q).ok());
  const FrameStats first = renderer->frame(view);
  EXPECT_LT(first.counters.marchedPixels, kWidth * kHeight * 2 / 3);
  const double before = rmse_255(whole, {renderer->radiance(), {}});
  for (int i = 0; i < 20; ++i) renderer->frame(view);
  const double after = rmse_255(whole, {renderer->radiance(), {}});
  std::printf("RMSE of 255: %.2f, after 20 frames %.2f\n", before, after);
  EXPECT_GT(before, 0.5);
  EXPECT_LT(after, 0.1);  // every pixel was marched
}

// Seen by the meter: before the first picture nobody knows what will look alike, and every pixel is marched.
TEST_F(Spread, NeedsAnExposure) {
  Scene scene = smallEarth();
  scene.output.exposure_ev.reset();
  const auto renderer = rendererOf(scene);
  ASSERT_NE(renderer, nullptr);
  Quality q = renderer->scene().quality;
  q.spread = 40;
  ASSERT_TRUE(renderer->setMarch(q).ok());
  EXPECT_EQ(renderer->frame(view).counters.marchedPixels, kWidth * kHeight);
  EXPECT_LT(renderer->frame(view).counters.marchedPixels, kWidth * kHeight);
}

}  // namespace
}  // namespace welkin
