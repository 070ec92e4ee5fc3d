#include "welkin/app/recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "random32.h"
#include "welkin/app/flight.h"
#include "welkin/app/fly_camera.h"
#include "welkin/core/files.h"

namespace welkin::app {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double kEarth_m = 6'360'000, kStep_s = 1.0 / 30;

struct Recorder : testing::Test {
  fs::path folder = fs::temp_directory_path() / ("welkin_recorder_test_" + std::to_string(::getpid()));
  Scene scene;
  void SetUp() override {
    fs::create_directories(folder / "scenes");
    scene.planet.radius_m = kEarth_m;
    scene.name = "plain";
    ASSERT_TRUE(saveScene(scene, folder / "scenes" / "plain.json").ok());
    scene.file = folder / "scenes" / "plain.json";
  }
  void TearDown() override { fs::remove_all(folder); }
};

FlyCamera camera() {
  FlyCamera c(kEarth_m);
  EXPECT_TRUE(c.setView(toView({46, 7, 20'000, 40, -20, 0, 58, {}}, kEarth_m)));
  return c;
}
FlyInput hands(double t) { return {.move = {0.3 * std::sin(t), -0.2, -1}, .turn_rad = {0.01 * std::cos(3 * t), 0.002 * std::sin(t)}}; }

// At the path's own step: what was seen is what is replayed, to the bit.
TEST_F(Recorder, AHundredFramesReplayEqual) {
  Recording recording;
  FlyCamera c = camera();
  double clock_s = 1234.5;
  for (int i = 0; i < 100; ++i, clock_s += kStep_s) ASSERT_TRUE(recording.add(clock_s, c.advance(hands(clock_s), kStep_s), 0.5 * i));
  auto path = recording.path(kStep_s);
  ASSERT_TRUE(path.ok()) << path.error().message;
  ASSERT_EQ(path->frames.size(), 100u);
  path->name = "test";
  path->width = 320, path->height = 180;
  const auto file = saveRecorded(*path, scene, false, folder / "paths", "flight");
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ(*file, folder / "paths" / "flight.json");
  const auto back = loadPath(*file);
  ASSERT_TRUE(back.ok()) << back.error().message;
  ASSERT_EQ(back->frames.size(), 100u);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(viewToJson(back->frames[i].view), viewToJson(recording.frames()[i].view)) << i;
    EXPECT_EQ(back->frames[i].time_s, 0.5 * double(i));
  }
  FlightOptions options;
  options.path = *file;
  options.out = folder / "out";
  const auto plan = planFlight(options);
  ASSERT_TRUE(plan.ok()) << plan.error().message;
  EXPECT_EQ(plan->end, 100);
  EXPECT_EQ(plan->scene.name, "plain");
  EXPECT_EQ(plan->size.width, 320);
}

// Frames of uneven length: what is replayed lies on the way that was flown.
TEST_F(Recorder, UnevenFramesComeToOneStep) {
  test::Random32 random(9);
  Recording recording;
  FlyCamera c = camera();
  double t = 0;
  ASSERT_TRUE(recording.add(0, c.view(), 0));
  while (t < 4) {
    const double dt_s = 0.004 + 0.02 * (random() / 4294967296.0);
    c.advance({.move = {0, -0.3, -1}}, dt_s);
    t += dt_s;
    ASSERT_TRUE(recording.add(t, c.view(), 2 * t));
  }
  const auto path = recording.path(kStep_s);
  ASSERT_TRUE(path.ok());
  EXPECT_EQ(path->frames.size(), std::size_t(std::floor(t / kStep_s)) + 1);
  for (std::size_t i = 0; i < path->frames.size(); ++i) {
    FlyCamera exact = camera();
    exact.advance({.move = {0, -0.3, -1}}, double(i) * kStep_s);
    // The chord of a frame of 24 ms: acceleration * dt^2 / 8, the greatest acceleration being 6 km/s / 0.25 s.
    EXPECT_LT(glm::length(path->frames[i].view.position_m - exact.view().position_m), 24'000 * 0.024 * 0.024 / 8 * 1.1) << i;
    EXPECT_NEAR(std::abs(glm::dot(path->frames[i].view.orientation, exact.view().orientation)), 1, 1e-9) << i;
    EXPECT_NEAR(path->frames[i].time_s, 2 * double(i) * kStep_s, 1e-9);
  }
}

TEST_F(Recorder, BetweenTwoViewsItStaysInTheShell) {
  const View a = toView({0, 0, 2, 90, 0, 0, 50, 1.0}, kEarth_m), b = toView({0, 90, 2, 90, 0, 0, 70, 3.0}, kEarth_m);
  const View half = viewBetween(a, b, 0.5);
  EXPECT_NEAR(glm::length(half.position_m), kEarth_m + 2, 1e-6);  // a chord would pass 1863 km below the ground
  const View there = toView({0, 45, 2, 90, 0, 0, 60, {}}, kEarth_m);
  EXPECT_LT(glm::length(half.position_m - there.position_m), 1e-6);
  EXPECT_NEAR(std::abs(glm::dot(half.orientation, there.orientation)), 1, 1e-14);  // and looks along the horizon
  EXPECT_NEAR(half.fov_deg, 60, 1e-12);
  EXPECT_NEAR(*half.exposure_ev, 2, 1e-12);
  EXPECT_EQ(viewToJson(viewBetween(a, b, 0)), viewToJson(a));
  EXPECT_EQ(viewToJson(viewBetween(a, b, 1)), viewToJson(b));
  View opposite = a;
  opposite.position_m = -a.position_m;
  for (const View& other : {a, opposite, View{}}) {
    const View v = viewBetween(a, other, 0.3);
    EXPECT_TRUE(std::isfinite(glm::length(v.position_m)) && std::abs(glm::length(v.orientation) - 1) < 1e-12);
  }
}

TEST_F(Recorder, BadFrames) {
  Recording recording;
  EXPECT_FALSE(recording.path(kStep_s).ok());
  View view = toView({0, 0, 100, 0, 0, 0, 58, {}}, kEarth_m);
  for (int i = 0; i <= 60; ++i) ASSERT_TRUE(recording.add(10 + i * kStep_s, view, i));
  view.position_m.x = std::nan("");
  EXPECT_FALSE(recording.add(20, view, 0));
  EXPECT_TRUE(recording.add(1, recording.frames()[0].view, 99));  // a clock that went back: in place of the last one
  EXPECT_EQ(recording.frames().size(), 61u);
  EXPECT_EQ(recording.frames().back().time_s, 99);
  EXPECT_FALSE(recording.path(0).ok());
  EXPECT_FALSE(recording.path(1e-9).ok());
  EXPECT_EQ(recording.path(kStep_s)->frames.size(), 61u);
}

TEST_F(Recorder, NeverOverwritesAndTakesAChangedSceneAlong) {
  Recording recording;
  ASSERT_TRUE(recording.add(0, toView({0, 0, 100, 0, 0, 0, 58, {}}, kEarth_m), 0));
  const auto path = *recording.path(kStep_s);
  EXPECT_EQ(*saveRecorded(path, scene, false, folder, "a"), folder / "a.json");
  EXPECT_THAT(*readFile(folder / "a.json"), HasSubstr("\"scenes/plain.json\""));
  const std::string first = *readFile(folder / "a.json");
  scene.name = "changed";
  EXPECT_EQ(*saveRecorded(path, scene, true, folder, "a"), folder / "a-2.json");
  EXPECT_EQ(*readFile(folder / "a.json"), first);
  EXPECT_EQ(loadScene(loadPath(folder / "a-2.json")->scene)->name, "changed");
  scene.file = folder / "shot.png";
  EXPECT_EQ(*saveRecorded(path, scene, false, folder, "b"), folder / "b.json");
  EXPECT_TRUE(fs::exists(folder / "b.scene.json"));
  FlightPath below = path;
  below.frames[0].view.position_m *= 0.5;
  EXPECT_FALSE(saveRecorded(below, scene, false, folder, "c").ok());
  EXPECT_FALSE(fs::exists(folder / "c.json"));
}

}  // namespace
}  // namespace welkin::app
