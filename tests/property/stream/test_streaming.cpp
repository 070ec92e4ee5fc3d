// Streaming against a GPU that counts: what rays can reach is always sound, whatever the flight and however late or lost the results.
#include <gtest/gtest.h>

#include <random>

#include "fake_gpu.h"

namespace welkin::test {
namespace {

constexpr double kRadius_m = 6'371'000;
const glm::dvec3 kToSun = glm::normalize(glm::dvec3(0.6, -0.3, 0.7));
const glm::ivec3 kToSunSigns(1, -1, 1);

struct World {
  RootFrame root = RootFrame::enclosing(kRadius_m, 9000);
  FakeSource source;
  StreamSettings settings;
  StreamState state;
  FakeGpu gpu;
  std::mt19937 random;
  std::uint64_t frame = 0;
  FrameEdits last;
  glm::dvec3 toSun = kToSun;

  World(std::uint32_t seed, std::uint32_t depth, std::uint32_t bricks, std::uint32_t groups, double limit = 0)
      : source(root, 1000, 9000, 9, seed),
        settings{depth, bricks, groups, limit, {}},
        state(source, root, settings),
        gpu(source, root, settings),
        random(seed) {}

  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random); }

  void step(const SelectionCamera& camera, std::uint32_t maxBricks, std::uint64_t delay = 2, double lost = 0, bool snap = false) {
    FrameInput input;
    input.frame = frame;
    input.camera = camera;
    input.maxBricks = maxBricks;
    input.snap = snap;
    input.toSun = toSun;
    input.results = gpu.lose(random, lost, gpu.results(frame));
    last = state.step(input);
    ASSERT_EQ(state.validate(), "") << "frame " << frame;
    ASSERT_EQ(gpu.apply(last, frame, delay, maxBricks, toSun), "") << "frame " << frame;
    ASSERT_LE(last.stats.bricks, settings.brickCapacity);
    ASSERT_LE(last.stats.groups, settings.groupCapacity);
    ASSERT_GT(last.sampleDetail, 0);
    ++frame;
  }

  void settle(const SelectionCamera& camera, std::uint32_t maxBricks = 2000) {
    for (int i = 0; i < 400; ++i) {
      step(camera, maxBricks, 2, 0, true);
      if (testing::Test::HasFatalFailure() || last.stats.settled) return;
    }
    FAIL() << "not settled after 400 frames, " << last.stats.pendingBricks << " pending";
  }

  // Points that a visible ray samples: is the level that the detail asks for there? Counts those that are not.
  int missing(const SelectionCamera& camera, int rays) {
    int bad = 0;
    sample(camera, rays, [&](glm::uvec3 p, std::uint32_t level) {
      const NodeAddress got = gpu.descendTo(p, level);
      if (got.level < level && !source.bounds(got.corner, got.level).empty()) ++bad;
    });
    return bad;
  }

  // The oldest light that visible rays sample.
  double oldestSampled_rad(const SelectionCamera& camera, int rays) {
    double most = 0;
    sample(camera, rays, [&](glm::uvec3 p, std::uint32_t level) {
      std::uint32_t brick = 0;
      gpu.descendTo(p, level, &brick);
      if (brick != 0) most = std::max(most, gpu.light_rad(brick, toSun));
    });
    return most;
  }

  template <class Look>
  void sample(const SelectionCamera& camera, int rays, const Look& look) {
    for (int i = 0; i < rays; ++i) {
      const double x = uniform(-1, 1) * camera.tanHalfFovX, y = uniform(-1, 1) * camera.tanHalfFovY;
      const glm::dvec3 direction = glm::normalize(camera.forward + camera.right * x + camera.up * y);
      for (double t = 50; t < 4e6; t *= 1.05) {
        const glm::dvec3 at = camera.position_m + direction * t;
        const double altitude_m = glm::length(at) - kRadius_m;
        if (altitude_m < 0) break;
        if (altitude_m < source.base_m() || altitude_m > source.top_m()) continue;
        const double far = std::max(t, static_cast<double>(last.sampleNear_m));
        std::uint32_t level = settings.depth;
        while (level > 0 && far > last.sampleDetail * root.nodeSize_m(level)) --level;
        look(root.toFixed(at), level);
      }
    }
  }
};

SelectionCamera cameraAt(double latitude_rad, double longitude_rad, double altitude_m, double heading_rad, double pitch_rad) {
  SelectionCamera c;
  const double cl = std::cos(latitude_rad), sl = std::sin(latitude_rad), co = std::cos(longitude_rad), so = std::sin(longitude_rad);
  const glm::dvec3 up(cl * co, cl * so, sl), east(-so, co, 0), north = glm::cross(up, east);
  const glm::dvec3 level = north * std::cos(heading_rad) + east * std::sin(heading_rad);
  c.position_m = up * (kRadius_m + altitude_m);
  c.forward = glm::normalize(level * std::cos(pitch_rad) + up * std::sin(pitch_rad));
  c.right = glm::normalize(glm::cross(c.forward, up));
  c.up = glm::cross(c.right, c.forward);
  c.tanHalfFovY = std::tan(0.5);
  c.tanHalfFovX = c.tanHalfFovY * 16 / 9;
  return c;
}

bool empty(const FrameEdits& e) { return e.generate.empty() && e.nodes.empty() && e.dirty.empty() && e.light.empty(); }

class Flight : public testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Seeds, Flight, testing::Values(1u, 2u, 3u, 4u, 5u, 6u));

TEST_P(Flight, RandomFlightsAndTeleportsKeepTheTreeSound) {
  RecordProperty("seed", static_cast<int>(GetParam()));
  World w(GetParam(), 12, 600, GetParam() % 2 ? 400 : 90);
  double latitude = 0.3, longitude = 0.2, altitude = 400'000, heading = 0;
  for (int i = 0; i < 250; ++i) {
    if (w.uniform(0, 1) < 0.03) {
      latitude = w.uniform(-1.5, 1.5);
      longitude = w.uniform(-3, 3);
      altitude = std::exp(w.uniform(std::log(2.0), std::log(3e7)));
    }
    latitude += 2e-4;
    altitude *= w.uniform(0.93, 1.05);
    heading += w.uniform(-0.05, 0.05);
    const auto delay = static_cast<std::uint64_t>(w.random() % 7);
    w.step(cameraAt(latitude, longitude, altitude, heading, w.uniform(-1.5, 0.3)), static_cast<std::uint32_t>(w.random() % 60), delay,
           i < 150 ? 0.1 : 0, w.random() % 20 == 0);
    if (HasFatalFailure()) return;
  }
  w.settle(cameraAt(latitude, longitude, 3000, 0, -0.1));
  if (HasFatalFailure()) return;
  EXPECT_EQ(w.missing(cameraAt(latitude, longitude, 3000, 0, -0.1), 300), 0);
}

TEST_P(Flight, WhatIsSampledOnAFlightIsResident) {
  World w(GetParam(), 13, 3000, 3000);
  double latitude = 0.3, altitude = 200'000;
  w.settle(cameraAt(latitude, 0, altitude, 0, -0.5));
  if (HasFatalFailure()) return;
  int missing = 0;
  for (int i = 0; i < 250; ++i) {
    altitude = std::max(2.0, altitude * 0.97);
    latitude += std::max(altitude, 1000.0) * 0.02 / kRadius_m;
    const SelectionCamera camera = cameraAt(latitude, 0, altitude, 0.002 * i, -0.5 + 0.002 * i);
    w.step(camera, 400);
    if (HasFatalFailure()) return;
    if (i % 5 == 0) missing += w.missing(camera, 40);
  }
  // The flight starts from rest at full speed, a jump that nothing could foresee: the glide may lag a few frames behind there.
  EXPECT_LE(missing, 0);
}

// Inside the clouds, faster than the finest levels can follow: detail must neither collapse nor be promised where it is not.
TEST_P(Flight, AFastFlightThroughCloudKeepsItsDetail) {
  World w(GetParam(), 20, 3000, 3000);
  const auto at = [](int i) { return cameraAt(0.3 + i * 150.0 / kRadius_m, 0, 5000, 0, 0); };
  w.settle(at(0));
  if (HasFatalFailure()) return;
  int missing = 0;
  double least = 1e9;
  for (int i = 1; i < 70; ++i) {
    w.step(at(i), 800);
    if (HasFatalFailure()) return;
    if (i < 30) continue;  // it starts at full speed, which nothing could foresee
    least = std::min<double>(least, w.last.sampleDetail);
    missing += w.missing(at(i + 2), 20);  // drawn two frames later
  }
  EXPECT_EQ(missing, 0);
  EXPECT_GT(least, 2);
}

// With too few bricks a frame the wanted tree is not there for long; what is promised as sampled must be there all the same.
TEST_P(Flight, AColdStartPromisesOnlyWhatIsThere) {
  World w(GetParam(), 13, 3000, 3000);
  const SelectionCamera camera = cameraAt(0.3, 0.1, 6000, 0, -0.3);
  int missing = 0;
  double least = 1e9, most = 0;
  for (int i = 0; i < 60; ++i) {
    w.step(camera, 40, 2, 0, true);
    if (HasFatalFailure()) return;
    missing += w.missing(camera, 20);
    least = std::min<double>(least, w.last.sampleDetail);
    most = std::max<double>(most, w.last.sampleDetail);
  }
  EXPECT_EQ(missing, 0);
  EXPECT_LT(least, 0.1);  // only the root
  EXPECT_GT(most, 4);     // and then a lot
}

// Bricks come few at a time and in any order; each one's light is that of the tree as it is in the end.
TEST_P(Flight, LightFollowsWhatComesTowardsTheSun) {
  World w(GetParam(), 13, 3000, 3000);
  const SelectionCamera camera = cameraAt(0.3, 0.1, 6000, 0, -0.3);
  std::uint64_t lag = 0, lit = 0, generated = 0;
  for (int i = 0; i < 400 && !w.last.stats.settled; ++i) {
    w.step(camera, 40);
    if (HasFatalFailure()) return;
    lag = std::max(lag, w.gpu.latestLight(kToSunSigns, w.frame - 1));
    lit += w.last.light.size(), generated += w.last.generate.size();
  }
  ASSERT_TRUE(w.last.stats.settled);
  EXPECT_LT(lag, 6u);  // frames, as long as it waits for others that come with it
  EXPECT_GT(lag, 0u);  // else nothing came out of order, and this tests nothing
  EXPECT_TRUE(w.gpu.allLitSinceTheLastCame());
  EXPECT_LT(lit, 5 * generated);  // first, for neighbours, at leisure while it refines, and once in the end
}

glm::dvec3 sunAfter(double angle_rad) {
  return {kToSun.x * std::cos(angle_rad) - kToSun.y * std::sin(angle_rad), kToSun.x * std::sin(angle_rad) + kToSun.y * std::cos(angle_rad), kToSun.z};
}
// Of small angles the chord is the angle: 1e-5 of it at 0.03 rad.
double apart_rad(glm::dvec3 a, glm::dvec3 b) { return glm::length(a - b); }

// A sun that moves: the oldest light that rays sample is no older than is told, nor than it takes to light those bricks in turn; and
// all of it is exact once the sun rests.
TEST_P(Flight, LightFollowsTheSun) {
  constexpr double kStep_rad = 2e-4, kDisc_rad = 0.00465;
  constexpr std::uint32_t kLit = 100;  // bricks a frame
  World w(GetParam(), 13, 3000, 3000);
  const SelectionCamera camera = cameraAt(0.3, 0.1, 6000, 0, -0.3);
  w.settle(camera);
  if (HasFatalFailure()) return;
  const double round = std::ceil(double(w.last.stats.bricks) / kLit) + 2;
  double told_rad = 0, sampled_rad = 0;
  std::size_t lit = 0;
  for (int i = 1; i <= 300; ++i) {
    w.toSun = sunAfter(i * kStep_rad);
    w.step(camera, kLit);
    if (HasFatalFailure()) return;
    const double is_rad = w.oldestSampled_rad(camera, 5), told = apart_rad(w.last.oldestSun, w.toSun);
    ASSERT_LE(is_rad, told + 1e-6) << "frame " << i;  // bricks keep it in floats
    told_rad = std::max(told_rad, told), sampled_rad = std::max(sampled_rad, is_rad);
    lit += w.last.light.size();
  }
  // Moved by its disc, then all bricks in turn at the worst; those lit first in one round may be last in the next.
  EXPECT_LT(told_rad, kDisc_rad + 2 * round * kStep_rad);
  EXPECT_GT(sampled_rad, kDisc_rad / 2);  // else this tests nothing
  EXPECT_LT(told_rad, 2 * sampled_rad);   // and is not told of what nobody sees: a few rays find about the oldest
  EXPECT_LE(lit, 300 * kLit);
  for (int i = 0; i < 2 * round && !w.last.stats.settled; ++i) w.step(camera, kLit);
  ASSERT_TRUE(w.last.stats.settled);
  EXPECT_EQ(w.gpu.oldestLight_rad(w.toSun), 0);
  EXPECT_EQ(w.last.oldestSun, w.toSun);
  w.step(camera, kLit);
  EXPECT_TRUE(empty(w.last)) << "it rests";
}

// A sun that moved once, while the camera flies and bricks come all the time: each brick that was there is lit for it once, not again and again.
TEST_P(Flight, AMoveOfTheSunIsWorkedOffWhileBricksCome) {
  World w(GetParam(), 13, 3000, 3000);
  w.settle(cameraAt(0.3, 0.1, 6000, 0, -0.3));
  if (HasFatalFailure()) return;
  const std::size_t there = w.last.stats.bricks;
  w.toSun = sunAfter(0.1);
  std::size_t lit = 0, came = 0;
  int frames = 0;
  for (; frames < 200; ++frames) {
    const SelectionCamera camera = cameraAt(0.3 + 1e-4 * frames, 0.1, 6000, 0, -0.3);
    w.step(camera, 200);
    if (HasFatalFailure()) return;
    came += w.last.generate.size();
    lit += w.last.light.size();
    if (frames > 1 && w.last.oldestSun == w.toSun && w.gpu.oldestLight_rad(w.toSun) == 0) break;
  }
  RecordProperty("frames", frames);
  EXPECT_LT(frames, 150) << there << " bricks, 100 a frame, and some go on to come";
  EXPECT_GT(came, 20u) << "else this tests nothing";
  EXPECT_LT(lit, there + 4 * came) << "each once for the sun; new ones as in LightFollowsWhatComesTowardsTheSun";
}

// Slow enough, its light is left alone until it has moved by its own disc.
TEST_P(Flight, ASlowSunIsLitForSeldom) {
  World w(GetParam(), 12, 2000, 2000);
  const SelectionCamera camera = cameraAt(0.3, 0.1, 6000, 0, -0.3);
  w.settle(camera);
  if (HasFatalFailure()) return;
  constexpr double kStep_rad = 2.5e-5;  // 186 steps a disc
  for (int i = 1; i <= 180; ++i) {
    w.toSun = sunAfter(i * kStep_rad / glm::length(glm::dvec2(kToSun)));
    w.step(camera, 200);
    if (HasFatalFailure()) return;
    ASSERT_TRUE(w.last.light.empty()) << "frame " << i;
  }
  std::size_t lit = 0;
  for (int i = 181; i <= 250; ++i) {
    w.toSun = sunAfter(i * kStep_rad / glm::length(glm::dvec2(kToSun)));
    w.step(camera, 200);
    if (HasFatalFailure()) return;
    lit += w.last.light.size();
  }
  EXPECT_EQ(lit, w.last.stats.bricks - 1);  // each once; the zero brick has none
}

TEST_P(Flight, AStaticSceneIsSilentAndATremblingCameraNearlySo) {
  World w(GetParam(), 14, 2000, 2000);
  const SelectionCamera camera = cameraAt(0.5, 1, 5000, 1, -0.2);
  w.settle(camera);
  if (HasFatalFailure()) return;
  EXPECT_GT(w.last.stats.bricks, 1500u);
  for (int i = 0; i < 100; ++i) {
    w.step(camera, 256);
    if (HasFatalFailure()) return;
    ASSERT_TRUE(empty(w.last)) << "frame " << i;
    ASSERT_TRUE(w.last.stats.settled);
  }
  for (int i = 0; i < 100; ++i) {
    SelectionCamera shaken = camera;
    shaken.position_m += glm::dvec3(w.uniform(-1, 1), w.uniform(-1, 1), w.uniform(-1, 1));
    w.step(shaken, 256);
    if (HasFatalFailure()) return;
    ASSERT_TRUE(empty(w.last)) << "frame " << i;
  }
}

TEST(Streaming, ALimitIsKeptAndEverythingInViewAtFullDepthIsSampledThere) {
  World limited(3, 14, 20000, 20000, 6.0);
  const SelectionCamera camera = cameraAt(0.5, 1, 12000, 1, -0.4);
  limited.settle(camera);
  if (HasFatalFailure()) return;
  EXPECT_LE(limited.last.stats.selectedDetail, 6.0);
  EXPECT_NEAR(limited.last.sampleDetail, 6.0 / 1.15, 0.01);
  EXPECT_LT(limited.last.stats.bricks, 20000u);
  World whole(3, 7, 60000, 60000);
  whole.settle(camera, 20000);
  if (HasFatalFailure()) return;
  EXPECT_LT(whole.last.stats.bricks, 60000u);
  EXPECT_EQ(whole.missing(camera, 200), 0);
  // 4,000 km away, with the last quarter of the range blending: the finest level is asked for.
  EXPECT_GE(whole.last.sampleDetail * whole.root.nodeSize_m(7) * 0.75, 500'000);
}

TEST(Streaming, AnEmptyWorldAsksForNothing) {
  World w(1, 12, 100, 100);
  struct Nothing : FakeSource {
    using FakeSource::FakeSource;
    Bounds bounds(glm::uvec3, std::uint32_t) const override { return {}; }
  } nothing(w.root, 1000, 2000);
  StreamState state(nothing, w.root, {12, 100, 100, 0});
  for (std::uint64_t i = 0; i < 3; ++i) {
    FrameInput input;
    input.frame = i;
    input.camera = cameraAt(0, 0, 1000, 0, 0);
    const FrameEdits e = state.step(input);
    EXPECT_TRUE(e.generate.empty() && e.light.empty());
    EXPECT_EQ(e.nodes.empty(), i > 0);
    EXPECT_TRUE(e.stats.settled);
  }
}

TEST(Streaming, AllResultsNeverComing) {
  World w(2, 12, 500, 500);
  for (int i = 0; i < 60; ++i) {
    w.step(cameraAt(0.1, 0.001 * i, 8000, 0, -0.3), 64, 1'000'000);
    if (HasFatalFailure()) return;
    EXPECT_FALSE(w.last.stats.settled);
  }
  EXPECT_EQ(w.gpu.shown().size(), 0u);
}

TEST(Streaming, TheBandHoldsTheCloudAndIsTight) {
  World w(2, 13, 6000, 6000);
  w.settle(cameraAt(0.1, 0, 4000, 0, 0));
  if (HasFatalFailure()) return;
  EXPECT_LE(w.last.bandBase_m, 1000.f + 1500);
  EXPECT_GE(w.last.bandTop_m, 8000.f);
  // The coarsest level in view decides; it must not be that of the root's voxel, 1,800 km.
  EXPECT_GT(w.last.bandBase_m, -40'000.f);
  EXPECT_LT(w.last.bandTop_m, 50'000.f);
}

TEST(Streamer, ResultDoesNotDependOnTiming) {
  const RootFrame root = RootFrame::enclosing(kRadius_m, 9000);
  const FakeSource source(root, 1000, 9000, 9, 7);
  const StreamSettings settings{12, 500, 400, 0};
  const auto fly = [&](std::uint32_t jitterSeed) {
    Streamer streamer(source, root, settings, jitterSeed);
    FakeGpu gpu(source, root, settings);
    std::vector<FrameEdits> all;
    for (std::uint64_t frame = 0; frame < 80; ++frame) {
      FrameInput input;
      input.frame = frame;
      input.camera = cameraAt(0.2 + 0.0005 * static_cast<double>(frame), 0, 30'000 - 300.0 * static_cast<double>(frame), 0, -0.4);
      input.maxBricks = 40;
      input.results = gpu.results(frame);
      streamer.post(input);
      if (frame >= 2) {
        all.push_back(streamer.take(frame - 2));
        EXPECT_EQ(gpu.apply(all.back(), frame, 1, 40), "");
      }
    }
    return all;
  };
  const auto a = fly(0), b = fly(99);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].nodes.size(), b[i].nodes.size());
    for (std::size_t k = 0; k < a[i].nodes.size(); ++k) {
      ASSERT_EQ(a[i].nodes[k].node, b[i].nodes[k].node);
      ASSERT_EQ(a[i].nodes[k].words.word, b[i].nodes[k].words.word);
      ASSERT_EQ(a[i].nodes[k].words.group, b[i].nodes[k].words.group);
    }
    ASSERT_EQ(a[i].generate.size(), b[i].generate.size());
    for (std::size_t k = 0; k < a[i].generate.size(); ++k) ASSERT_EQ(a[i].generate[k].brick, b[i].generate[k].brick);
    ASSERT_EQ(a[i].light.size(), b[i].light.size());
    ASSERT_EQ(a[i].sampleDetail, b[i].sampleDetail);
    ASSERT_EQ(a[i].bandBase_m, b[i].bandBase_m);
  }
}

}  // namespace
}  // namespace welkin::test
