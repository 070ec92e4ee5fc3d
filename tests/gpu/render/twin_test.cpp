// The shared functions on the GPU against the same functions compiled as C++, on seeded random inputs.
#include <cstdio>

#include "random32.h"
#include "small_earth.h"
#include "twins.h"
#include "welkin/clouds/density_source.h"
#include "welkin/render/tone_curve.h"
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/camera.glsl.h"
#include "welkin/shared/cloud_light.glsl.h"
#include "welkin/shared/noise.glsl.h"
#include "welkin/shared/sun_depth.glsl.h"
#include "welkin/shared/tonemap.glsl.h"
#include "welkin/shared/tree_block.glsl.h"
#include "welkin/shared/walk.glsl.h"

namespace welkin {
namespace {
using namespace test;
using namespace shared;

constexpr std::size_t kRows = 10240;  // 160 groups of 64

struct Row {
  glm::uvec4 place;
  glm::vec4 ray, other;
};

std::vector<Row> randomRows() {
  Random32 random(20261122);
  const auto unit = [&] { return float(random() >> 8) * 0x1p-24f; };
  std::vector<Row> rows(kRows);
  for (Row& row : rows) {
    row.place = {random(), random(), random(), random() % 24};
    if (random() % 8 == 0) row.place.x = random() % 2 ? 0xFFFFFFFFu : 0u;  // the root's own faces
    glm::vec3 d{unit() - 0.5f, unit() - 0.5f, unit() - 0.5f};
    if (random() % 16 == 0) d.x = 0;
    d /= std::max(glm::length(d), 1e-3f);
    row.ray = {d.x, d.y, d.z, unit() * unit() * 2e6f};
    row.other = {unit(), unit(), unit(), unit()};
  }
  return rows;
}

TEST_F(Twins, AddressesWalksAndLevels) {
  const RootFrame root = RootFrame::enclosing(kEarthRadius_m, 20'000);
  const float stepsPerMetre = float(root.stepsPerMetre());
  const auto rows = randomRows();
  const auto answers =
      run<std::uint32_t>("octree_twin.comp", rows, 48, {}, 0, [&](const gpu::Program& p) { p.set("u_stepsPerMetre", stepsPerMetre); });
  double worst[20] = {};
  for (std::size_t i = 0; i < kRows; ++i) {
    const uvec3 p{rows[i].place.x, rows[i].place.y, rows[i].place.z};
    const uint level = rows[i].place.w;
    const vec3 dir(rows[i].ray);
    const float t = rows[i].ray.w;
    const vec4 x = rows[i].other;
    const uint* gpu = &answers[48 * i];
    const uvec3 corner = nodeCorner(p, level), child = childCorner(corner, level, p.x & 7u), s = brickSample(corner, level, p & 7u);
    const uint word = packWord(p.x & kBrickMask, p.y & 31u, level);
    const uint mapLevel = std::max(level, 6u);
    // 15 goes through exp2, whose last bits may differ: skipped where the level is about to change.
    const float place = kMapReach * std::exp2(x.x * 20);
    const bool atEdge = std::abs(place / std::exp2(std::round(std::log2(place))) - 1) < 1e-4f;
    const uint integers[20] = {corner.x,
                               corner.y,
                               corner.z,
                               childOctant(p, level),
                               child.x,
                               child.y,
                               child.z,
                               s.x,
                               s.y,
                               s.z,
                               word,
                               wordBrick(word),
                               wordMaxCode(word),
                               wordLevel(word),
                               wordEmpty(word),
                               atEdge ? gpu[15] : mapLevelAt(std::exp2(x.x * 20), 6, 16),
                               detailAt(x.y * 70000, 16).level,
                               mapEntry(p >> (32 - mapLevel), mapLevel, 6),
                               brickTexel(p.x & kBrickMask).z,
                               levelMask(level)};
    for (int k = 0; k < 20; ++k) ASSERT_EQ(gpu[k], integers[k]) << "integer " << k << " of row " << i;
    const Walk walk = startWalk(dvec3(p) + 0.5, dir, stepsPerMetre);
    const uvec3 to = walkTo(walk, t);
    const vec3 local = nodeLocal(p, level), ahead = glm::step(0.0f, dir);
    const float floats[20] = {walk.dirSteps.x,
                              walk.dirSteps.y,
                              walk.dirSteps.z,
                              nodeExit(nodeSteps(p, level), levelSteps(level), ahead, (2.0f * ahead - 1.0f) * vec3(x) * 1e6f),
                              local.x,
                              local.y,
                              local.z,
                              walkError(t, x.x),
                              leaveNode(walk, nodeSteps(p, level), levelSteps(level), t, x.x + 0.01f),
                              levelSteps(level),
                              detailAt(x.y * 70000, 16).parentWeight,
                              uintBitsToFloat(walk.origin.x),
                              uintBitsToFloat(to.x),
                              uintBitsToFloat(to.y),
                              uintBitsToFloat(to.z),
                              walk.metrePerStep.x,
                              walk.metrePerStep.y,
                              encodeDepth(x.z * 200),
                              decodeDepth(x.w),
                              maxCodeValue(p.y & 31u)};
    for (int k = 0; k < 20; ++k) {
      // 11 to 14 are integers in disguise
      const bool integer = k >= 11 && k <= 14;
      worst[k] = std::max(
          worst[k], integer ? (gpu[20 + k] == std::bit_cast<uint>(floats[k]) ? 0.0 : 1e9) : ulps(uintBitsToFloat(gpu[20 + k]), floats[k]));
    }
  }
  for (int k = 0; k < 20; ++k) {
    // + - * and integers: equal. One division each in 10 (by a constant) and 15 to 18: 2.5 ulp, GLSL's promise.
    const double limit = k == 10 || (k >= 15 && k <= 18) ? 2.5 : 0;
    EXPECT_LE(worst[k], limit) << "float " << k;
  }
}

TEST_F(Twins, NoiseAndCloudLight) {
  Random32 random(7);
  std::vector<glm::uvec4> places(kRows);
  for (auto& p : places) p = {random(), random(), random(), random()};
  const auto answers = run<std::uint32_t>("noise_twin.comp", places, 16);
  double worst[10] = {};
  for (std::size_t i = 0; i < kRows; ++i) {
    const glm::uvec4 x = places[i];
    const uvec3 p{x.x, x.y, x.z};
    const uint shift = 1 + x.w % 31, zShift = 1 + (x.w >> 8) % 31;
    const uint* gpu = &answers[16 * i];
    ASSERT_EQ(gpu[0], mixBits(x.x));
    ASSERT_EQ(gpu[1], latticeX(x.x, shift, 1));
    ASSERT_EQ(gpu[2], latticeY(x.y, shift, 0));
    ASSERT_EQ(gpu[3], latticeZ(x.z, zShift, 1));
    const float n = noise3(p, shift, zShift, x.w);
    const float cosine = float(x.x >> 8) / 8388608.0f - 1, encoded = float(x.y >> 8) / 16777216.0f;
    const CloudPhases phases = cloudPhases(cosine);
    const CloudSlab slab = cloudSlab(float(x.z >> 8) / 1048576.0f, float(x.w >> 8) / 1048576.0f, 0.5f * cosine, 0.3f, cosine);
    const float floats[10] = {cellFraction(x.x, shift),
                              n,
                              billowNoise(n, 0.7f),
                              phases.single,
                              phases.broad,
                              openShare(20 * encoded, slab),
                              sunSource(phases, 20 * encoded, slab),
                              skySource(encoded),
                              groundSource(1, encoded),
                              cloudShadow(encoded * 20)};
    for (int k = 0; k < 10; ++k) {
      const float value = uintBitsToFloat(gpu[4 + k]);
      worst[k] = std::max(worst[k], double(std::abs(value - floats[k])) / (k < 3 ? 1.0 : std::max(double(std::abs(floats[k])), 1e-3)));
    }
  }
  std::printf("noise %.1e, phases %.1e, sun %.1e, shadow %.1e\n", worst[1], worst[3], worst[6], worst[9]);
  EXPECT_EQ(worst[0], 0) << "shifts, masks and an exact product";
  // + - * in the same order; a compiler that fuses or reorders them moves the result by a few roundings of values up to 1.5 * 511.5.
  EXPECT_LE(worst[1], 1e-6);
  EXPECT_LE(worst[2], 2e-6);
  // Roots and quotients of phaseHenyeyGreenstein: under ten roundings of 2^-24 and the denominator's 1e-6 near the forward peak.
  for (int k = 3; k < 6; ++k) EXPECT_LE(worst[k], 1e-5) << k;
  // exp2 of software GL: 3e-5 relative, to the fourth power here.
  EXPECT_LE(worst[6], 2e-4);
  EXPECT_LE(worst[7], 1e-6);
  EXPECT_LE(worst[8], 1e-6);
  EXPECT_LE(worst[9], 5e-5);
}

// Bricks where the source has something to say: around places within its altitudes, at every level.
std::vector<glm::uvec4> cloudBricks(const RootFrame& root, const DensitySource& source, glm::dvec3 centre, double spread) {
  Random32 random(3);
  const auto unit = [&] { return double(random()) * 0x1p-32; };
  std::vector<glm::uvec4> bricks;
  while (bricks.size() < 320) {
    glm::dvec3 d{unit() * 2 - 1, unit() * 2 - 1, unit() * 2 - 1};
    if (glm::length(d) < 0.1 || glm::length(d) > 1) continue;
    d = glm::normalize(centre + spread * glm::normalize(d));
    const auto p = root.toFixed(d * (root.planetRadius_m + source.base_m() + (source.top_m() - source.base_m()) * unit()));
    const std::uint32_t level = random() % 25;
    const auto corner = nodeCorner(p, level);
    if (!source.bounds(corner, level).empty()) bricks.emplace_back(corner, level);
  }
  return bricks;
}

// What the GPU fills a brick with, against density() at each of its samples.
TEST_F(Twins, DensityOfEverySource) {
  const RootFrame root = RootFrame::enclosing(kEarthRadius_m, 20'000);
  const glm::dvec3 ball = directionTo(10, 20) * (kEarthRadius_m + 5000);
  const std::pair<const char*, CloudSource> sources[] = {
      {"layers", LayersSource{}}, {"sphere", SphereSource{ball, 4000, 0.03}}, {"slab", SlabSource{1000, 3000, 0.02}}};
  for (const auto& [name, cloudSource] : sources) {
    Scene scene = smallEarth();
    scene.clouds->sources = {cloudSource};
    const auto source = std::move(makeDensitySource(scene, root).value());
    const bool isBall = source->shader().find("sphere") != std::string::npos;
    const auto bricks = cloudBricks(root, *source, isBall ? glm::normalize(ball) : glm::dvec3(0), isBall ? 5e-4 : 1);
    const auto words = source->shaderParams();
    const auto params = std::move(gpu::Buffer::create(account, "parameters", std::max<std::size_t>(words.size() * 4, 32)).value());
    params.upload(0, words);
    const auto answers = run<float>(
        "density_twin.comp", bricks, 512, {{"SOURCE_SHADER", source->shader()}}, 8,
        [&](const gpu::Program&) { params.bind(GL_SHADER_STORAGE_BUFFER, WK_SOURCE_PARAMS_BINDING); }, 1);
    double worst = 0;
    std::size_t partly = 0, zero = 0;
    for (std::size_t i = 0; i < answers.size(); ++i) {
      const glm::uvec4 brick = bricks[i / 512];
      const auto at = static_cast<uint>(i % 512);
      const auto p = brickSample({brick.x, brick.y, brick.z}, brick.w, {at & 7u, at >> 3 & 7u, at >> 6});
      const float cpu = source->density(p, brick.w) / source->maxExtinction(), gpu = answers[i] / source->maxExtinction();
      const double difference = std::abs(cpu - gpu);
      worst = std::max(worst, difference);
      partly += cpu > 0 && cpu < 1;
      zero += cpu == 0;
    }
    const double n = double(answers.size());
    std::printf("%-7s %4.1f %% partly cloudy, %4.1f %% clear, greatest difference %.1e of the maximum\n", name, 100 * double(partly) / n,
                100 * double(zero) / n, worst);
    EXPECT_GT(double(partly), 0.05 * n) << "the comparison must meet cloud";
    EXPECT_GT(double(zero), 0.02 * n) << "and clear air";
    // A brick keeps 16 bits, steps of 1.5e-5. A column's place in a noise cell is off from a point's by a rounding, some 2e-7 of the noise;
    // the ramp of the sharpest layer makes that 20 times as much. 1e-5 is below what a brick keeps.
    EXPECT_LE(worst, 1e-5) << name;
  }
}

TEST_F(Twins, CameraRays) {
  Random32 random(5);
  std::vector<glm::vec2> points(kRows);
  for (auto& p : points) p = {float(random()) * 0x1p-31f - 1, float(random()) * 0x1p-31f - 1};
  const auto buffer = std::move(gpu::Buffer::create(account, "camera", sizeof(CameraBlock)).value());
  for (const double altitude_m : {2.0, 9000.0, 99'000.0, 400e3, 30e6, 1e9}) {
    for (const double pitch_deg : {-90.0, -10.0, 5.0}) {
      const View view = viewAt(33, 44, altitude_m, 50, pitch_deg, altitude_m > 1e8 ? 1 : 50);
      const auto axis = [&](glm::dvec3 a, double scale, double w) {
        const glm::dvec3 v = view.orientation * a * scale;
        return dvec4{v.x, v.y, v.z, w};
      };
      const double tangent = std::tan(view.fov_deg * M_PI / 360), r = glm::length(view.position_m);
      const CameraBlock camera{{view.position_m.x, view.position_m.y, view.position_m.z, r - kEarthRadius_m},
                               axis({0, 0, -1}, 1, kEarthRadius_m),
                               axis({1, 0, 0}, tangent * 1.6, 100'000),
                               axis({0, 1, 0}, tangent, r)};
      buffer.upload(0, std::as_bytes(std::span(&camera, 1)));
      buffer.bind(GL_UNIFORM_BUFFER, WK_CAMERA_BINDING);
      const auto answers = run<float>("ray_twin.comp", points, 8);
      std::size_t misses = 0;
      for (std::size_t i = 0; i < kRows; ++i) {
        const Ray ray = cameraRay(camera, points[i]);
        const float* gpu = &answers[8 * i];
        const float t = std::max(ray.exit_m - ray.anchor_m, 0.0f) * 0.37f;
        const float altitude = altitudeAlong(ray.altitude_m, ray.mu, t, float(kEarthRadius_m));
        // fp64 on both sides, rounded once to float: one unit in the last place, except where a root nearly vanishes at a sphere's rim.
        for (int k = 0; k < 3; ++k) ASSERT_LE(ulps(gpu[k], ray.dir[k]), 1) << altitude_m << " " << i;
        if ((gpu[3] >= 0) != (ray.ground_m >= 0) || (gpu[4] >= 0) != (ray.anchor_m >= 0)) {
          ++misses;
          continue;
        }
        const double scale = std::max(1.0, double(std::abs(ray.exit_m)));
        ASSERT_NEAR(gpu[3], ray.ground_m, 1e-6 * scale);
        ASSERT_NEAR(gpu[4], ray.anchor_m, 1e-6 * scale);
        ASSERT_NEAR(gpu[5], ray.mu, 1e-6);
        ASSERT_NEAR(gpu[6], ray.exit_m, 1e-6 * scale);
        // float: num / (r + R) with num up to 1e13 of 24 bits over 1.3e7 m
        ASSERT_NEAR(gpu[7], altitude, 0.1) << altitude_m << " " << i;
      }
      EXPECT_LE(misses, 2u) << "a ray that just touches a sphere may fall on either side";
    }
  }
}

TEST_F(Twins, ToneCurves) {
  Random32 random(9);
  const auto unit = [&] { return float(random() >> 8) * 0x1p-24f; };
  std::vector<glm::vec4> colours(kRows);
  for (auto& c : colours) c = {unit(), unit(), unit(), std::exp2(unit() * 24 - 12)};  // exposed: 0 to 4096
  colours[0] = {0, 0, 0, 1}, colours[1] = {-1, 0, 1e30f, 1e6f};
  for (const ToneCurve curve : {ToneCurve::Aces, ToneCurve::Reinhard, ToneCurve::Lottes, ToneCurve::Uchimura}) {
    const auto answers = run<glm::vec4>("tone_twin.comp", colours, 2, {{"TONE_CURVE", toneCurveFunction(curve)}});
    double worst = 0, worstShown = 0;
    for (std::size_t i = 0; i < kRows; ++i) {
      const glm::vec3 c = toned(curve, toneInput(glm::vec3(colours[i]), colours[i].a));
      const glm::vec3 shown = displayValues(c, shared::uint(i), shared::uint(i * 7));
      const glm::vec4 gpu = answers[2 * i], gpuShown = answers[2 * i + 1];
      ASSERT_EQ(gpu.a, pixelDither(shared::uint(i), shared::uint(i * 7)));
      ASSERT_NEAR(gpuShown.a, luminance(c), 5e-5f);
      for (int k = 0; k < 3; ++k) {
        ASSERT_TRUE(gpu[k] >= 0 && gpu[k] <= 1) << i;
        worst = std::max(worst, double(std::abs(gpu[k] - c[k])));
        worstShown = std::max(worstShown, double(std::abs(gpuShown[k] - shown[k])));
      }
    }
    std::printf("%-9s greatest difference %.1e, shown %.1e\n", kToneCurveNames[std::size_t(curve)], worst, worstShown);
    EXPECT_LE(worst, 5e-5) << "pow and exp of a GPU, of values up to 1 (measured: 6e-7 on Mesa)";
    // pow(x, 1 / 2.4) is steepest where its straight part ends, 12.92: a twentieth of a step of 8 bits.
    EXPECT_LE(worstShown, 2e-4);
  }
}

}  // namespace
}  // namespace welkin
