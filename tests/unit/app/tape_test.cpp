#include "welkin/app/tape.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "welkin/app/flight.h"
#include "welkin/app/recorder.h"
#include "welkin/physics/scene_io.h"

namespace welkin::app {
namespace {
namespace fs = std::filesystem;

constexpr double kEarth_m = 6'360'000, kStep_s = 1.0 / 30;

FlightPath someFlight(int frames = 101) {
  FlightPath path;
  path.name = "test";
  path.width = 320, path.height = 180, path.warmUp = 7, path.timeStep_s = kStep_s;
  for (int i = 0; i < frames; ++i) path.frames.push_back({toView({0.01 * i, 7, 1000.0 + i / 3.0, 40, -20, 0, 58, {}}, kEarth_m), 0.5 * i});
  return path;
}
std::string text(const PathFrame& f) { return viewToJson(f.view) + std::to_string(f.time_s); }

TEST(Tape, IsWhatWasFlownToTheBit) {
  const FlightPath flown = someFlight();
  const Tape tape(flown);
  EXPECT_EQ(tape.frames(), 101);
  EXPECT_NEAR(tape.duration_s(), 100 * kStep_s, 1e-12);
  EXPECT_EQ(pathToJson(tape.path()), pathToJson(flown));
  for (int i = 0; i < 101; ++i) EXPECT_EQ(text(tape.at(i * kStep_s)), text(flown.frames[std::size_t(i)])) << i;
  EXPECT_EQ(text(tape.at(-1)), text(flown.frames.front()));
  EXPECT_EQ(text(tape.at(1e9)), text(flown.frames.back()));
  const PathFrame between = tape.at(10.25 * kStep_s);
  EXPECT_NEAR(between.time_s, 5.125, 1e-12);
  EXPECT_NEAR(glm::length(between.view.position_m) - kEarth_m, 1000 + 10.25 / 3, 1e-6);
}

TEST(Tape, PointsStayInOrderAndWithin) {
  Tape tape(someFlight());
  tape.setIn(30), tape.setOut(60);
  EXPECT_EQ(tape.path().frames.size(), 31u);
  tape.setIn(80);
  EXPECT_EQ(tape.in(), 60);
  tape.setOut(-5);
  EXPECT_EQ(tape.out(), 60);
  EXPECT_EQ(tape.path().frames.size(), 1u);
  tape.setOut(1000), tape.setIn(-1000);
  EXPECT_EQ(tape.path().frames.size(), 101u);
}

TEST(Tape, CutsAndUndo) {
  Tape tape(someFlight());
  tape.keepBetween();
  EXPECT_FALSE(tape.canUndo());  // there was nothing to throw away
  const Tape before = tape;
  for (int i = 0; i <= 20; ++i) tape.setIn(i);  // one drag
  tape.letGo();
  tape.setOut(50), tape.letGo();
  tape.keepBetween();
  EXPECT_EQ(tape.frames(), 31);
  EXPECT_EQ(tape.in(), 0);
  EXPECT_EQ(tape.out(), 30);
  EXPECT_EQ(text(tape.at(0)), text(someFlight().frames[20]));
  EXPECT_EQ(tape.undoes(), "cut");
  tape.undo();
  EXPECT_EQ(tape.frames(), 101);
  EXPECT_EQ(tape.in(), 20);
  EXPECT_EQ(tape.out(), 50);
  EXPECT_FALSE(tape.same(before));
  tape.undo(), tape.undo();
  EXPECT_TRUE(tape.same(before));
  EXPECT_EQ(tape.in(), 0);  // the drag was one edit
  EXPECT_FALSE(tape.canUndo());
  tape.redo(), tape.redo(), tape.redo();
  EXPECT_EQ(tape.frames(), 31);
  EXPECT_FALSE(tape.canRedo());
  EXPECT_EQ(tape.path().warmUp, 7);
  EXPECT_EQ(tape.path().width, 320);
}

TEST(Tape, NoFramesOneFrameAndNoStep) {
  Tape none;
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.duration_s(), 0);
  none.setIn(4), none.setOut(9), none.keepBetween(), none.undo();
  EXPECT_TRUE(none.path().frames.empty());
  FlightPath single = someFlight(1);
  single.timeStep_s = 0;  // a file may say so
  Tape one(single);
  EXPECT_EQ(one.duration_s(), 0);
  EXPECT_GT(one.step_s(), 0);
  EXPECT_EQ(text(one.at(5)), text(single.frames[0]));
  EXPECT_EQ(text(one.at(std::nan(""))), text(single.frames[0]));
  EXPECT_EQ(one.path().timeStep_s, 0);
}

// Whatever is cut can be saved, and `welkin fly` takes it.
TEST(Tape, EveryCutIsAPathToFly) {
  const fs::path folder = fs::temp_directory_path() / ("welkin_tape_test_" + std::to_string(::getpid()));
  Scene scene;
  scene.planet.radius_m = kEarth_m;
  fs::create_directories(folder);
  scene.file = folder / "plain.json";
  ASSERT_TRUE(saveScene(scene, scene.file).ok());
  Tape tape(someFlight());
  for (const auto& [in, out] : {std::pair(0, 0), {100, 100}, {3, 77}, {0, 100}}) {
    tape.setIn(0), tape.setOut(out), tape.setIn(in);
    FlightOptions options;
    options.path = *saveRecorded(tape.path(), scene, false, folder, "cut");
    options.out = folder / "out";
    const auto plan = planFlight(options);
    ASSERT_TRUE(plan.ok()) << plan.error().message;
    EXPECT_EQ(plan->end, out - in + 1);
    EXPECT_EQ(text(plan->path.frames.front()), text(someFlight().frames[std::size_t(in)]));
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace welkin::app
