// The march on the GPU against the reference of the same tree.
#include <cstdio>

#include "gl_fixture.h"
#include "small_earth.h"
#include "welkin/reference/cloud_picture.h"
#include "welkin/reference/tree_field.h"
#include "welkin/render/renderer.h"

namespace welkin {
namespace {
using namespace test;
using reference::Fade;
using Truth = GlTest;

constexpr int kWidth = 96, kHeight = 54;
constexpr double kTolerance = 1e-5;  // of a weight: a tenth of what half floats round

std::unique_ptr<Renderer> rendererOf(gpu::Context& context) {
  Scene scene = smallEarth();
  scene.quality.detail = 8;  // settles in a second; nodes are large, so that much of a picture fades between levels
  auto made = Renderer::create(context, scene, {.width = kWidth, .height = kHeight, .timing = false});
  EXPECT_TRUE(made.ok()) << made.error().message;
  return made.ok() ? std::move(*made) : nullptr;
}

const View& nearView() {
  static const View view = viewAt(45, 0, 9000, 0, -12);
  return view;
}

// Root of the mean square of the difference in green, as a share of the second picture's mean.
double difference(const ImageF& a, const ImageF& b) {
  double sum = 0, level = 0;
  for (std::size_t i = 1; i < a.rgba.size(); i += 4) {
    const double off = double(a.rgba[i]) - double(b.rgba[i]);
    sum += off * off, level += double(b.rgba[i]);
  }
  const double n = double(a.rgba.size()) / 4;
  return std::sqrt(sum / n) / (level / n);
}

ImageF truthOf(Renderer& renderer, const View& view, const TreeData& tree, Fade fade) {
  const reference::TreeField field(tree, fade);
  const auto picture = reference::marchPicture(field, renderer.camera(view), {kWidth, kHeight, {}, kTolerance, 2});
  EXPECT_TRUE(picture.converged);
  EXPECT_LE(picture.worstError, kTolerance);
  EXPECT_TRUE(renderer.drawWith(view, reference::weightsOf(picture, kWidth, kHeight)).ok());
  return renderer.radiance();
}

// With ever shorter steps the march comes to the reference. What stays: weights rounded to half floats (2^-12 of each, 2.4e-4), and rays
// whose level turns by where exactly a node is entered, which the march looks up a little behind the face.
TEST_F(Truth, MarchConvergesToTheReference) {
  const auto renderer = rendererOf(*context);
  ASSERT_NE(renderer, nullptr);
  for (const View& view : {nearView(), viewAt(45, 0, 400e3, 0, -40)}) {
    ASSERT_TRUE(renderer->settle(view).residency.settled);
    const TreeData tree = renderer->tree(view);
    const ImageF truth = truthOf(*renderer, view, tree, Fade::ByNode), smooth = truthOf(*renderer, view, tree, Fade::Smooth);
    double error[4];
    int n = 0;
    for (const double step : {0.32, 0.16, 0.08, 0.005}) {
      Quality quality = renderer->scene().quality;
      quality.step = step;
      ASSERT_TRUE(renderer->setMarch(quality).ok());
      renderer->preview(view);
      error[n++] = difference(renderer->radiance(), truth);
    }
    std::printf("step 0.32: %.5f  0.16: %.5f  0.08: %.5f  0.005: %.5f; levels by node: %.5f\n", error[0], error[1], error[2], error[3],
                difference(truth, smooth));
    EXPECT_GT(error[0], 0.003) << "the first step errs: else there is nothing to converge";
    EXPECT_LT(error[1], 0.6 * error[0]) << "between first and second order: light has a kink where the sun's depth is all of the chord";
    EXPECT_LT(error[2], 0.5 * error[1]);
    EXPECT_LT(error[3], 5e-4);
  }
}

// The way back into a picture, and the tree's name.
TEST_F(Truth, GivenCloudsAreDrawnAndTreesAreNamed) {
  const auto renderer = rendererOf(*context);
  ASSERT_NE(renderer, nullptr);
  renderer->settle(nearView());
  const std::vector<shared::CloudWeights> none(kWidth * kHeight, {0, 0, 0, 1, shared::kSkyDistance_m}),
      black(kWidth * kHeight, {0, 0, 0, 0, 1e-3f});
  ASSERT_TRUE(renderer->drawWith(nearView(), none).ok());
  const ImageF clear = renderer->radiance();
  for (std::size_t i = 3; i < clear.rgba.size(); i += 4) ASSERT_EQ(clear.rgba[i], 0.0f) << "no opacity";
  ASSERT_TRUE(renderer->drawWith(nearView(), black).ok());
  for (const float v : renderer->radiance().rgba) ASSERT_TRUE(v == 1.0f || v < 1e-6f) << "a black wall before the eye, of opacity 1";
  EXPECT_FALSE(renderer->drawWith(nearView(), std::span(none).subspan(1)).ok()) << "a pixel is missing";

  TreeData tree = renderer->tree(nearView());
  const std::uint64_t name = reference::contentHash(tree);
  EXPECT_EQ(reference::contentHash(renderer->tree(nearView())), name);
  shared::NodeWords node = tree.nodes[0];  // on to a node that has a brick
  while (shared::wordBrick(node.word) == shared::kZeroBrick) {
    std::uint32_t i = 0;
    while (shared::wordEmpty(tree.nodes[node.group + i].word)) ++i;
    node = tree.nodes[node.group + i];
  }
  const glm::uvec3 at = shared::brickTexel(shared::wordBrick(node.word));
  std::uint16_t& texel = tree.bricks[0][2 * (at.x + std::size_t{shared::kAtlasX * 8} * (at.y + std::size_t{shared::kAtlasY * 8} * at.z))];
  texel ^= 1;
  EXPECT_NE(reference::contentHash(tree), name) << "one bit of one texel";
  texel ^= 1;
  EXPECT_EQ(reference::contentHash(tree), name);
  tree.block.sunDir.x += 1e-6f;
  EXPECT_NE(reference::contentHash(tree), name) << "another sun";
}

}  // namespace
}  // namespace welkin
