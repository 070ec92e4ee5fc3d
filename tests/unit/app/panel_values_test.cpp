// What panels edit: the history of edits, the sun by date and place.
#include <gtest/gtest.h>

#include <cmath>

#include "random32.h"
#include "welkin/app/edit_history.h"
#include "welkin/app/presets.h"
#include "welkin/app/sun_place.h"

namespace welkin::app {
namespace {

TEST(EditHistory, UndoAndRedo) {
  EditHistory<int> h(0);
  EXPECT_FALSE(h.canUndo() || h.canRedo());
  EXPECT_EQ(h.undo(), 0);
  EXPECT_EQ(h.redo(), 0);
  h.push(1, "a");
  h.push(2, "b");
  EXPECT_EQ(h.undoes(), "b");
  EXPECT_EQ(h.undo(), 1);
  EXPECT_EQ(h.redoes(), "b");
  EXPECT_EQ(h.undo(), 0);
  EXPECT_EQ(h.undo(), 0);
  EXPECT_EQ(h.redo(), 1);
  h.push(7, "c");  // what was undone is gone
  EXPECT_FALSE(h.canRedo());
  EXPECT_EQ(h.undo(), 1);
  EXPECT_EQ(h.redo(), 7);
}

TEST(EditHistory, OneDragIsOneEdit) {
  EditHistory<int> h(0);
  for (int i = 1; i <= 50; ++i) h.push(i, "drag");
  EXPECT_EQ(h.undo(), 0);
  EXPECT_EQ(h.redo(), 50);
  h.push(51, "drag");  // after a redo it is a new one
  EXPECT_EQ(h.undo(), 50);
  h.push(60, "drag");
  h.settle();
  h.push(70, "drag");  // so it is after the mouse was let go
  EXPECT_EQ(h.undo(), 60);
  EXPECT_EQ(h.undo(), 50);
}

TEST(EditHistory, ForgetsTheOldest) {
  EditHistory<int> h(0, 3);
  for (int i = 1; i <= 10; ++i) h.push(i, std::to_string(i));
  int undone = 0;
  for (; h.canUndo(); ++undone) h.undo();
  EXPECT_EQ(undone, 3);
  EXPECT_EQ(h.current(), 7);
}

TEST(SunPlace, ThereAndBack) {
  test::Random32 random(2);
  const auto between = [&](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  for (int i = 0; i < 500; ++i) {
    const double latitude_deg = between(-90, 90), longitude_deg = between(-180, 180);
    const SunInSky sun{between(-89.9, 89.9), between(0, 360)};
    const SunInSky back = sunInSky(sunDirection(sun, latitude_deg, longitude_deg), latitude_deg, longitude_deg);
    EXPECT_NEAR(back.elevation_deg, sun.elevation_deg, 1e-10);
    EXPECT_NEAR(std::remainder(back.azimuth_deg - sun.azimuth_deg, 360), 0, 1e-8);
  }
}

// Closed form: at noon of an equinox the sun stands 90 degrees less the latitude high, in the south.
TEST(SunPlace, NoonOfAnEquinox) {
  const double days = *daysSinceJ2000("2024-03-20T12:07:00Z");  // the mean noon of Greenwich, late by the equation of time
  const SunInSky sun = sunInSky(sunDirectionAt(days), 51.5, 0);
  EXPECT_NEAR(sun.elevation_deg, 38.5, 0.2);  // 9 hours after the equinox: 0.15 degrees of declination
  EXPECT_NEAR(sun.azimuth_deg, 180, 0.5);     // half a minute of time and the sun's 0.13 degrees
}

TEST(SunPlace, TimesComeBack) {
  for (const char* text : {"2024-06-21T12:00:00Z", "1600-01-01T00:00:00Z", "2399-12-31T23:59:59Z", "2000-02-29T06:07:08.250Z"}) {
    EXPECT_EQ(utcText(*daysSinceJ2000(text)), text);
  }
  EXPECT_EQ(utcText(1e6), "");
  EXPECT_EQ(utcText(std::nan("")), "");
}

TEST(Presets, EachIsFinerThanTheLast) {
  for (std::size_t i = 1; i < kPresets.size(); ++i) {
    EXPECT_GT(kPresets[i].budget_bytes, kPresets[i - 1].budget_bytes);
    EXPECT_LT(kPresets[i].step, kPresets[i - 1].step);
    EXPECT_LE(kPresets[i].spread, kPresets[i - 1].spread);
  }
}

TEST(Presets, AreRecognisedAndKeepWhatIsTheScenes) {
  Quality q;
  q.depth = 11;
  q.seed = 99;
  q.detail = 500;
  q.stepRule = StepRule::Node;
  EXPECT_EQ(presetOf(q), "");
  const std::map<std::string, Quality> own{{"mine", q}};
  for (const Preset& preset : kPresets) {
    ASSERT_TRUE(applyPreset(preset.name, q));
    EXPECT_EQ(presetOf(q, own), preset.name);
    EXPECT_EQ(q.depth, 11);
    EXPECT_EQ(q.seed, 99u);
    EXPECT_EQ(q.detail, 0);
    EXPECT_EQ(q.stepRule, Quality{}.stepRule);
  }
  EXPECT_FALSE(applyPreset("best", q));
  ASSERT_TRUE(applyPreset("mine", q, own));
  EXPECT_EQ(presetOf(q, own), "mine");
  q.step *= 1.01;
  EXPECT_EQ(presetOf(q, own), "");
}

}  // namespace
}  // namespace welkin::app
