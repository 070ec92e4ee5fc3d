// The source without voxels: closed forms for a shell, and bricks filled from a ball, which come to it as their voxels shrink.
#include "welkin/reference/source_field.h"

#include <gtest/gtest.h>

#include "welkin/clouds/layers_source.h"
#include "welkin/clouds/sphere_source.h"
#include "welkin/reference/tree_field.h"

namespace welkin::reference {
namespace {

constexpr double kRadius_m = 1000;
const glm::dvec3 kSun = glm::normalize(glm::dvec3(0.6, 0, 0.8));

// A whole octree of the source, every node to the depth with its brick: density, the sun's depth and chords at its corners.
TreeData filled(const DensitySource& source, const SourceField& field, const RootFrame& root, std::uint32_t depth) {
  TreeData tree;
  shared::TreeBlock& b = tree.block;
  b.half_m = root.half_m, b.stepsPerMetre = root.stepsPerMetre();
  b.sunDir = glm::vec4(glm::vec3(kSun), 1);
  b.rootSize_m = float(2 * root.half_m);
  b.detail = 1e6f;  // the deepest level everywhere
  b.maxExtinction_per_m = source.maxExtinction();
  b.bandBase_m = -2000, b.bandTop_m = b.cloudTop_m = 200;
  b.planetRadius_m = float(kRadius_m);
  b.depth = depth;
  b.bricksPerTexture = 4096;
  std::uint32_t bricks = 1;
  tree.bricks.emplace_back(std::size_t{32} * 2048 * 8 * 4 * 2);
  const auto node = [&](const auto& self, std::size_t at, glm::uvec3 corner, std::uint32_t level) -> void {
    if (source.bounds(corner, level).empty() && level > 0) {
      tree.nodes[at] = {shared::packWord(shared::kZeroBrick, 0, 0), shared::kNoGroup};
      return;
    }
    std::uint32_t brick = shared::kZeroBrick;
    if (level == depth) {
      brick = bricks++;
      ASSERT_LT(brick, b.bricksPerTexture);
      const glm::uvec3 texel = shared::brickTexel(brick);
      tree.chords.resize(bricks);
      for (std::uint32_t i = 0; i < 8; ++i) {
        const glm::dvec3 place = root.toPlanet(shared::brickSample(corner, level, 7u * glm::uvec3(i & 1, i >> 1 & 1, i >> 2)));
        const glm::dvec2 chords = field.chords(place, field.sunDepth(place));
        tree.chords[brick][i] = {std::lround(encodeDepth(chords.x) * 65535), std::lround(encodeDepth(chords.y) * 65535)};
      }
      for (std::uint32_t i = 0; i < 512; ++i) {
        const glm::uvec3 s{i & 7, i >> 3 & 7, i >> 6};
        const glm::uvec3 p = shared::brickSample(corner, level, s), to = texel + s;
        std::uint16_t* out = tree.bricks[0].data() + 2 * (to.x + std::size_t{32} * (to.y + std::size_t{2048} * to.z));
        out[0] = std::uint16_t(std::lround(source.density(p, level) / source.maxExtinction() * 65535));
        out[1] = std::uint16_t(std::lround(encodeDepth(field.sunDepth(root.toPlanet(p))) * 65535));
      }
    }
    std::uint32_t group = shared::kNoGroup;
    if (level < depth) {
      group = std::uint32_t(tree.nodes.size());
      tree.nodes.resize(tree.nodes.size() + 8);
      for (std::uint32_t i = 0; i < 8; ++i) self(self, group + i, shared::childCorner(corner, level, i), level + 1);
    }
    tree.nodes[at] = {shared::packWord(brick, 31, 0), group};
  };
  tree.nodes.resize(8);
  node(node, 0, glm::uvec3(0), 0);
  return tree;
}

TEST(SourceField, VoxelsComeToTheBall) {
  const RootFrame root = RootFrame::enclosing(kRadius_m, 250);
  const SphereCloud ball({{100, 0, 1060}, 80, 0.02}, root);
  double last = 1;
  for (const std::uint32_t depth : {5u, 6u}) {  // voxels of 10 and 5 m, the ball's edge being 8 m or a voxel wide
    const SourceField field(ball, root, {.detail = {.depth = depth}, .towardsSun = kSun});
    const TreeData tree = filled(ball, field, root, depth);
    const TreeField voxels(tree);
    double worst = 0, opaque = 0;
    for (int i = 0; i < 40; ++i) {
      const glm::dvec3 from{-400, 60 * std::sin(i * 1.7), 1100};
      const CameraRay ray = rayFrom(from, glm::normalize(glm::dvec3(100, 1.5 * (i - 20), 1060 + (i * 7 % 40) - 20) - from), kRadius_m);
      const CloudTruth a = marchClouds(voxels, ray, 1e-7), b = marchClouds(field, ray, 1e-6);
      worst = std::max({worst, std::abs(a.transmittance - b.transmittance), std::abs(a.sun - b.sun), 6 * std::abs(a.sky - b.sky)});
      opaque = std::max(opaque, 1 - b.transmittance);
      EXPECT_TRUE(a.converged && b.converged);
    }
    std::printf("depth %u: %.4f\n", depth, worst);
    EXPECT_GT(opaque, 0.8) << "rays through the ball";
    EXPECT_LT(worst, 0.6 * last);
    last = worst;
  }
  EXPECT_LT(last, 0.06) << "most of it are chords, linear between the corners of bricks half as large as the ball; 0.002 where light knew the sun's depth alone";
}

// A uniform shell: depth to the sun is extinction times the way to its top; vertical transmittance from space.
TEST(SourceField, ShellInClosedForm) {
  const double R = 6'360'000;
  const RootFrame root = RootFrame::enclosing(R, 20'000);
  const auto slab = LayeredClouds::slab({2000, 4000, 1e-3}, root);
  const glm::dvec3 up = glm::normalize(glm::dvec3(0.3, -0.2, 0.9));
  const std::uint32_t depth = 16;  // voxels of 28 m: the shell's faces are smooth over that
  const SourceField field(*slab, root, {.detail = {.depth = depth}, .eye_planet = up * (R + 1e4), .towardsSun = up});
  // Two points a voxel: on a face, which lies anywhere in one, they miss a tenth of its depth of 0.028
  EXPECT_NEAR(field.sunDepth(up * (R + 3000)), 1.0, 3e-3);
  EXPECT_NEAR(field.sunDepth(up * (R + 1000)), 2.0, 3e-3);
  EXPECT_EQ(field.sunDepth(up * (R + 9000)), 0.0);
  EXPECT_EQ(field.sunDepth(-up * (R + 3000)), kOpaqueDepth) << "behind the planet";
  const CloudTruth t = marchClouds(field, rayFrom(up * (R + 1e4), -up, R), 1e-6);
  EXPECT_NEAR(t.transmittance, std::exp(-2.0), 2e-4);
  // straight down with the sun behind: at depth tau both ways
  const CloudPhases p = cloudPhases(-1);
  const CloudSlab shell = cloudSlab(2, 2, 1, -1, -1);
  const glm::dvec2 chords = field.chords(up * (R + 2500), field.sunDepth(up * (R + 2500)));
  EXPECT_NEAR(chords.x, 2.0, 6e-3);
  EXPECT_NEAR(chords.y, 2.0, 6e-3);
  double expected = 0;
  const int n = 100'000;
  for (int i = 0; i < n; ++i) {
    const double tau = 2 * (i + 0.5) / n;
    expected += std::exp(-tau) * sunSource(p, tau, shell) * 2 / n;
  }
  EXPECT_NEAR(t.sun, expected, 2e-4);
}

}  // namespace
}  // namespace welkin::reference
