// Rays through clouds in double precision: closed forms, a hand-made tree against a sum over plain steps, the light model's twin.
#include "welkin/reference/cloud_march.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <limits>

#include "random32.h"
#include "welkin/reference/cloud_picture.h"
#include "welkin/reference/tree_field.h"

namespace welkin::reference {
namespace {

constexpr double kRadius_m = 1000;

// A field along any ray that is told by functions of the distance, smooth between breaks.
struct Told final : CloudField {
  double length_m = 1;
  std::vector<double> breaks;
  std::function<CloudSample(double)> sample;

  struct Along final : CloudAlong {
    const Told* told = nullptr;
    double enter(double t, double end) override {
      for (const double b : told->breaks)
        if (b > t) return std::min(b, end);
      return end;
    }
    bool empty() const override { return false; }
    CloudSample at(double t) const override { return told->sample(t); }
  };
  Stretch stretchOf(const CameraRay&) const override { return {0, length_m}; }
  std::unique_ptr<CloudAlong> along(const CameraRay&, double) const override {
    auto out = std::make_unique<Along>();
    out->told = this;
    return out;
  }
  glm::dvec3 towardsSun() const override { return {0, 1, 0}; }  // at right angles to the ray, and to all zeniths along it
  std::uint64_t contentHash() const override { return 1; }
};

CameraRay anyRay() { return rayFrom({0, 0, kRadius_m + 10}, {1, 0, 0}, kRadius_m); }
const CloudPhases kSideways = cloudPhases(0);

// As thick upright as along the sun's line: light that does not depend on the zenith.
constexpr double kChord = 0.6;
CloudSlab ball() {
  const double depth = decodeDepth(kChord);
  return cloudSlab(depth, depth, 0, 0, 0);
}

TEST(CloudMarch, EvenCloudOfAnyThickness) {
  for (const double depth : {1e-6, 1e-3, 0.1, 1.0, 10.0, 20.0, 1e3, 1e6}) {
    Told cloud;
    cloud.length_m = 500;
    cloud.sample = [&](double) { return CloudSample{depth / 500, 0.3, kChord, kChord}; };
    const CloudTruth t = marchClouds(cloud, anyRay(), 1e-9);
    const double opacity = -std::expm1(-depth);
    EXPECT_TRUE(t.converged);
    // below a transmittance of 1e-9 it ends
    EXPECT_NEAR(t.transmittance, std::exp(-depth), 1e-9) << depth;
    const double open = openShare(decodeDepth(0.3), ball());
    EXPECT_NEAR(t.sun, opacity * sunSource(kSideways, decodeDepth(0.3), ball()), 1e-9) << depth;
    EXPECT_NEAR(t.sky, opacity * open / M_PI, 1e-9) << depth;
    EXPECT_NEAR(t.ground, opacity * (1 - open) / M_PI, 1e-9) << depth;
    // where light is taken from on the average: 1/sigma - L / (e^tau - 1), relative to the rounding of 1 - T for thin cloud
    const double where = 500 * (1 / depth - (depth < 700 ? 1 / std::expm1(depth) : 0));
    EXPECT_NEAR(t.distance_m, where, 500 * (1e-9 / opacity + 1e-9)) << depth;
  }
}

// Density and light that change along the ray: extinction k t, and light that falls behind an edge, by a fine sum.
TEST(CloudMarch, SlopesAndJumps) {
  Told ramp;
  ramp.length_m = 100;
  ramp.sample = [](double t) { return CloudSample{4e-4 * t, 0}; };
  const double depth = 0.5 * 4e-4 * 100 * 100;  // 2
  const CloudTruth r = marchClouds(ramp, anyRay(), 1e-10);
  EXPECT_NEAR(r.transmittance, std::exp(-depth), 1e-12);
  // mean of t with density k t exp(-k t^2 / 2): by parts, the Gaussian integral less the edge
  const double k = 4e-4, L = 100;
  const double integral = std::sqrt(M_PI / (2 * k)) * std::erf(L * std::sqrt(k / 2)) - L * std::exp(-depth);
  EXPECT_NEAR(r.distance_m, integral / (1 - std::exp(-depth)), 1e-7);

  // a jump by a factor of 1e6 at an edge, the sun's depth growing behind it
  Told jump;
  jump.length_m = 100;
  jump.breaks = {40};
  jump.sample = [](double t) {
    return t < 40 ? CloudSample{1e-4, 0, kChord, kChord} : CloudSample{100, encodeDepth(100 * (t - 40)), kChord, kChord};
  };
  const CloudTruth j = marchClouds(jump, anyRay(), 1e-9);
  double behind = 0;  // the edge, over the light that is taken away
  const int n = 2'000'000;
  for (int i = 0; i < n; ++i) {
    const double left = (i + 0.5) / n;
    behind += sunSource(kSideways, -std::log(left), ball()) / n;
  }
  const double kept = std::exp(-0.004);
  const double expected = (1 - kept) * sunSource(kSideways, 0, ball()) + kept * behind;
  EXPECT_NEAR(j.sun, expected, 1e-8);
  EXPECT_TRUE(j.converged);
}

// The light model in double is the one that shaders run.
TEST(CloudMarch, LightModelIsTheSharedOne) {
  for (double c = -1; c <= 1; c += 0.125) {
    const CloudPhases own = cloudPhases(c);
    const shared::CloudPhases theirs = shared::cloudPhases(float(c));
    for (double tau = 0; tau < 150; tau = 1.5 * tau + 0.1)
      for (const double sunChord : {0.0, 0.3, 5.0, 300.0})
        for (const double upChord : {0.0, 0.2, 20.0})
          for (const double muSun : {-0.4, 0.1, 1.0}) {
            const CloudSlab slab = cloudSlab(tau + sunChord, upChord, muSun, 0.7, c);
            const shared::CloudSlab same = shared::cloudSlab(float(tau + sunChord), float(upChord), float(muSun), 0.7f, float(c));
            const double value = sunSource(own, tau, slab), open = openShare(tau, slab);
            // Floats: of a thick cloud's far side little is left of what is subtracted, a few roundings of a depth of 100.
            EXPECT_NEAR(double(shared::sunSource(theirs, float(tau), same)), value, 2e-6 * value + 2e-6) << c << " " << tau;
            EXPECT_NEAR(double(shared::openShare(float(tau), same)), open, 2e-6);
          }
  }
  EXPECT_NEAR(double(shared::skySource(0.3f)), skySource(0.3), 1e-7);
  EXPECT_NEAR(double(shared::groundSource(0.9f, 0.3f)), groundSource(0.9, 0.3), 1e-7);
}

// A root with eight children, each with a brick of random numbers; child 3 is empty, child 5 has no brick of its own.
TreeData smallTree() {
  TreeData tree;
  shared::TreeBlock& b = tree.block;
  const double half = 1100;
  b.half_m = half, b.stepsPerMetre = 0x1p31 / half;
  b.sunDir = glm::vec4(0, 0.6f, 0.8f, 1);
  b.rootSize_m = float(2 * half);
  b.detail = 1.3f;  // the root's level from 1430 m on, fading in from 1251 m
  b.maxExtinction_per_m = 0.004f;
  b.bandBase_m = -2000, b.bandTop_m = 90, b.cloudTop_m = 90;
  b.planetRadius_m = float(kRadius_m);
  b.depth = 1;
  b.bricksPerTexture = 1024;
  test::Random32 random(7);
  tree.bricks.emplace_back(std::size_t{32} * 2048 * 8 * 2);
  for (std::size_t i = 0; i < tree.bricks[0].size(); i += 2) {
    tree.bricks[0][i] = std::uint16_t(random() % 4 == 0 ? 0 : random() & 0xFFFF);
    tree.bricks[0][i + 1] = std::uint16_t(random() & 0xFFFF);
  }
  tree.chords.resize(10);
  for (auto& corners : tree.chords)
    for (auto& chord : corners) chord = {random() & 0xFFFF, random() & 0xFFFF};
  tree.nodes.resize(16);
  tree.nodes[0] = {shared::packWord(1, 31, 0), 8};
  for (std::uint32_t i = 0; i < 8; ++i)
    tree.nodes[8 + i] = {shared::packWord(i == 3 || i == 5 ? 0 : 2 + i, i == 3 ? 0 : 31, 0), shared::kNoGroup};
  for (std::uint32_t z = 0; z < 8; ++z)  // brick 0 is zero
    for (std::uint32_t y = 0; y < 8; ++y)
      for (std::uint32_t x = 0; x < 16; ++x) tree.bricks[0][x + 64 * (y + 2048 * z)] = 0;
  return tree;
}

// Straight from the definition: the value of a brick at a point of its node.
glm::dvec2 trilinear(const TreeField& field, std::uint32_t brick, glm::dvec3 inNode) {
  const glm::dvec3 c = glm::clamp(inNode * 7.0, 0.0, 6.999999999);
  glm::dvec2 sum{};
  for (std::uint32_t i = 0; i < 8; ++i) {
    const glm::uvec3 bit{i & 1, i >> 1 & 1, i >> 2};
    const glm::dvec3 f = c - glm::floor(c), w = glm::mix(1.0 - f, f, glm::dvec3(bit));
    sum += field.texel(brick, glm::uvec3(c) + bit) * (w.x * w.y * w.z);
  }
  return sum;
}

glm::dvec2 chordsAt(const TreeData& tree, std::uint32_t brick, glm::dvec3 inNode) {
  glm::dvec2 sum{};
  for (std::uint32_t i = 0; i < 8; ++i) {
    const glm::dvec3 w = glm::mix(1.0 - inNode, inNode, glm::dvec3(i & 1, i >> 1 & 1, i >> 2));
    sum += glm::dvec2(tree.chords[brick][i]) / 65535.0 * (w.x * w.y * w.z);
  }
  return sum;
}

TEST(CloudMarch, TreeAgreesWithPlainSteps) {
  const TreeData tree = smallTree();
  const TreeField field(tree);
  const glm::dvec3 from{-1850, 500, 700};
  int thick = 0;
  for (const glm::dvec3 towards :
       {glm::dvec3(1050, 150, -100), glm::dvec3(900, -700, 620), glm::dvec3(-200, 1000, 200), glm::dvec3(0, -300, 1000)}) {
    const glm::dvec3 dir = glm::normalize(towards - from);
    const CameraRay ray = rayFrom(from, dir, kRadius_m);
    const Stretch s = field.stretchOf(ray);
    if (s.empty()) continue;
    const CloudTruth truth = marchClouds(field, ray, 1e-8);
    const CloudPhases phases = cloudPhases(glm::dot(dir, field.towardsSun()));
    const int n = 400'000;
    const double dt = (s.far - s.near) / n;
    double light = 1, sun = 0, open = 0, weighted = 0;
    for (int i = 0; i < n; ++i) {
      const double t = s.near + (i + 0.5) * dt;
      const glm::dvec3 at = (from + dir * t) / 2200.0 + 0.5;  // in the root
      const glm::dvec3 childAt = at * 2.0 - glm::floor(at * 2.0);
      const std::uint32_t octant = std::uint32_t(at.x >= 0.5) | std::uint32_t(at.y >= 0.5) << 1 | std::uint32_t(at.z >= 0.5) << 2;
      const glm::dvec2 root = trilinear(field, 1, at);
      const glm::dvec2 child = octant == 3 || octant == 5 ? glm::dvec2(0) : trilinear(field, 2 + octant, childAt);
      const double r = 1.3f * 2200 / t / 2;  // 1 at the end of the children's reach
      const double parent = std::clamp((1 - 0.875 * r) / 0.125, 0.0, 1.0);
      const double a = child.x * (1 - parent), b = root.x * parent;
      const double share = a + b > 0 ? b / (a + b) : 0, encoded = glm::mix(child.y, root.y, share);
      const glm::dvec2 chord = glm::mix(chordsAt(tree, 2 + octant, childAt), chordsAt(tree, 1, at), share);
      const glm::dvec3 up = glm::normalize(from + dir * t);
      const double own = ownChord((a + b) * 0.004f, (octant == 3 ? 2200 : 1100) / 7.0);  // the empty child: its parent's voxels
      const CloudSlab slab = cloudSlab(std::max(decodeDepth(chord.x), own), std::max(decodeDepth(chord.y), own),
                                       glm::dot(up, field.towardsSun()), glm::dot(up, dir), glm::dot(dir, field.towardsSun()));
      const double kept = light * std::exp(-(a + b) * 0.004f * dt), gain = light - kept;
      sun += gain * sunSource(phases, decodeDepth(encoded), slab), open += gain * openShare(decodeDepth(encoded), slab),
          weighted += gain * t;
      light = kept;
    }
    thick += light < 0.5;
    // Midpoints of n steps: (dt / cell)^2 of what changes within a cell, and dt of the light where densities begin; both below 1e-5
    EXPECT_NEAR(truth.transmittance, light, 1e-5);
    EXPECT_NEAR(truth.sun, sun, 3e-5);
    EXPECT_NEAR(truth.sky, skySource(open), 1e-5);
    EXPECT_NEAR(truth.ground, groundSource(1 - light, open), 1e-5);
    EXPECT_NEAR(light < 0.999 ? truth.distance_m : 0, light < 0.999 ? weighted / (1 - light) : 0, 0.1);
  }
  EXPECT_GE(thick, 2) << "rays that meet something";
}

TEST(CloudMarch, PixelsAreAllOrSome) {
  const auto some = somePixels(64, 36, 4);
  EXPECT_EQ(some.size(), 16u * 9u);
  std::vector<int> rows(36), columns(64);
  for (const std::uint32_t p : some) ++rows[p / 64], ++columns[p % 64];
  for (const int n : rows) EXPECT_GT(n, 0);
  for (const int n : columns) EXPECT_GT(n, 0);
}

// A picture is kept under everything that it depends on; a file that is cut short is made again.
TEST(CloudPicture, IsNotDoneAgain) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "welkin-truth-cache";
  std::filesystem::remove_all(folder);
  ::setenv("WELKIN_CACHE", folder.c_str(), 1);
  Told cloud;
  cloud.length_m = 500;
  cloud.sample = [](double t) { return CloudSample{1e-3 + 1e-6 * t, 0.3}; };
  const shared::CameraBlock camera{{0, 0, kRadius_m + 10, 10}, {1, 0, 0, kRadius_m}, {0, 0.5, 0, 100}, {0, 0, 0.5, kRadius_m + 10}};
  PictureSettings settings{4, 3, {}, 1e-6, 1};
  const CloudPicture made = keptPicture(cloud, camera, settings), again = keptPicture(cloud, camera, settings);
  EXPECT_FALSE(made.kept);
  ASSERT_TRUE(again.kept);
  ASSERT_EQ(again.clouds.size(), 12u);
  EXPECT_EQ(again.pixels, made.pixels);
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(again.clouds[i].sun, made.clouds[i].sun);
  settings.tolerance = 1e-7;
  EXPECT_FALSE(keptPicture(cloud, camera, settings).kept);
  settings.pixels = {3, 5};
  EXPECT_FALSE(keptPicture(cloud, camera, settings).kept);
  for (const auto& entry : std::filesystem::directory_iterator(folder)) std::filesystem::resize_file(entry.path(), 200);
  EXPECT_FALSE(keptPicture(cloud, camera, settings).kept);
  EXPECT_TRUE(keptPicture(cloud, camera, settings).kept);
  EXPECT_TRUE(keptPicture(cloud, camera, {4, 3, {}, 1e-8, 1}, [](double) { return false; }).clouds.empty()) << "stopped";
  ::setenv("WELKIN_CACHE", "", 1);
  EXPECT_FALSE(keptPicture(cloud, camera, settings).kept) << "no cache";
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace welkin::reference
