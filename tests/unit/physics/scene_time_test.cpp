// What a scene's time moves, against what is known of days and winds.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "welkin/physics/scene_io.h"
#include "welkin/physics/scene_time.h"
#include "welkin/physics/sun_position.h"

namespace welkin {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
double apart_deg(glm::dvec3 a, glm::dvec3 b) { return 2 * std::asin(glm::length(a - b) / 2) / kDegree; }

TEST(SceneTime, TheSunGoesWestOnceADay) {
  Sun sun;
  sun.direction_planet = directionTo(20, 30);
  EXPECT_EQ(sunAt(sun, 1e6), sun.direction_planet) << "no day: it stands still";
  sun.day_s = 86'400;
  EXPECT_EQ(sunAt(sun, 0), sun.direction_planet);
  // 1e-13: a few roundings of a unit vector's parts.
  EXPECT_LT(glm::length(sunAt(sun, 3600) - directionTo(20, 15)), 1e-13);
  EXPECT_LT(glm::length(sunAt(sun, -7200) - directionTo(20, 60)), 1e-13);
  EXPECT_LT(glm::length(sunAt(sun, 86'400.0 * 1e6 + 3600) - directionTo(20, 15)), 1e-13) << "whole days go first, exactly";
  sun.day_s = -86'400;
  EXPECT_LT(glm::length(sunAt(sun, 3600) - directionTo(20, 45)), 1e-13) << "it rises in the west";
  const glm::dvec3 noon = directionTo(-10, 77);
  EXPECT_LT(glm::length(sunAt(Sun{{}, 0, sunStartOf(sun, noon, 12'345), sun.day_s}, 12'345) - noon), 1e-13);
}

// The mean day leaves out that declination and equation of time change: 0.4 degrees a day at most (23.44 degrees * 2 pi / 365.24), and
// 30 s of time a day, 0.13 degrees (near the end of December).
TEST(SceneTime, ADayOfTheEarthIsNearTheTrueOne) {
  for (const char* date : {"2026-03-20T12:00Z", "2026-06-21T00:00Z", "2026-12-24T06:00Z"}) {
    const auto scene = parseScene(std::string(R"({"sun": {"utc": ")") + date + "\"}}", "test.json");
    ASSERT_TRUE(scene.ok());
    EXPECT_EQ(scene->sun->day_s, 86'400);
    const double days = *daysSinceJ2000(date);
    for (const double part : {0.25, 0.5, 1.0}) {
      const auto truth = subsolarPoint(days + part);
      const double off_deg = apart_deg(sunAt(*scene->sun, 86'400 * part), directionTo(truth.latitude_deg, truth.longitude_deg));
      EXPECT_LT(off_deg, (0.41 + 0.13) * part) << date;
    }
  }
}

TEST(SceneTime, TheMeanWindTurnsTheClouds) {
  Scene scene;
  scene.planet.radius_m = 6'360'000;
  EXPECT_EQ(windTurn_rad(scene, 1000), 0) << "no clouds";
  scene.clouds = Clouds{};
  EXPECT_EQ(windTurn_rad(scene, 1000), 0) << "no wind";
  scene.clouds->windEast_m_per_s = 20;
  EXPECT_NEAR(windTurn_rad(scene, 3600) * scene.planet.radius_m, 72'000, 1e-9 * 72'000);
  scene.clouds->windEast_m_per_s = -20;
  EXPECT_NEAR((windTurn_rad(scene, 3600) - 2 * std::numbers::pi) * scene.planet.radius_m, -72'000, 1e-6);  // 1e-15 of a turn
}

TEST(SceneTime, ATurnedViewSeesTheSame) {
  const View view = toView({47, 8, 1000, 30, -10, 5, 58, {}}, 6'360'000);
  EXPECT_EQ(turned(view, 0).position_m, view.position_m);
  const View east = turned(view, 20 * kDegree), made = toView({47, 28, 1000, 30, -10, 5, 58, {}}, 6'360'000);
  EXPECT_LT(glm::length(east.position_m - made.position_m), 1e-6) << "a part in 6e12";
  EXPECT_LT(glm::length(east.orientation * glm::dvec3(0, 0, -1) - made.orientation * glm::dvec3(0, 0, -1)), 1e-12);
  EXPECT_LT(glm::length(east.orientation * glm::dvec3(0, 1, 0) - made.orientation * glm::dvec3(0, 1, 0)), 1e-12);
}

// The shortest and longest days and times that a file may have.
TEST(SceneTime, NothingOfItIsNotANumber) {
  for (const double day_s : {5e-324, -1e-300, 1e12, -1e12, 0.0})
    for (const double time_s : {0.0, 1.0, -kGreatestTime_s, kGreatestTime_s}) {
      const glm::dvec3 to = sunAt(Sun{{}, 0, {0.6, 0, 0.8}, day_s}, time_s);
      EXPECT_NEAR(glm::length(to), 1, 1e-15) << day_s << " " << time_s;
    }
}

}  // namespace
}  // namespace welkin
