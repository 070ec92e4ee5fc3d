#include "welkin/app/view_flight.h"

#include <gtest/gtest.h>

#include <cmath>

#include "random32.h"
#include "welkin/app/fly_camera.h"
#include "welkin/app/geographic.h"

namespace welkin::app {
namespace {

constexpr double kEarth_m = 6'360'000;

GeographicView geographic(double latitude_deg, double longitude_deg, double altitude_m = 2, double heading_deg = 0, double pitch_deg = 0,
                          double roll_deg = 0, double fov_deg = 58) {
  return {latitude_deg, longitude_deg, altitude_m, heading_deg, pitch_deg, roll_deg, fov_deg, {}};
}

double between(test::Random32& random, double low, double high) { return low + (high - low) * (random() / 4294967296.0); }

View anyView(test::Random32& random) {
  const double latitude_deg = between(random, -90, 90), longitude_deg = between(random, -180, 180);
  const double altitude_m = std::exp(between(random, std::log(2.0), std::log(1e10)));
  const double heading_deg = between(random, 0, 360), pitch_deg = between(random, -90, 90), roll_deg = between(random, -180, 180);
  const GeographicView g = geographic(latitude_deg, longitude_deg, altitude_m, heading_deg, pitch_deg, roll_deg, between(random, 1, 120));
  return toView(g, kEarth_m);
}

void expectGoodFlight(const View& from, const View& to, const std::string& what) {
  const ViewFlight flight(from, to, kEarth_m);
  const double end_s = flight.duration_s(), lowest_m = std::min(glm::length(from.position_m), glm::length(to.position_m));
  ASSERT_GT(end_s, 0) << what;
  ASSERT_LT(end_s, 30) << what;
  EXPECT_EQ(flight.at(0).position_m, from.position_m) << what;
  EXPECT_EQ(flight.at(end_s).position_m, to.position_m) << what;
  EXPECT_EQ(flight.at(end_s).orientation, to.orientation) << what;
  const int steps = 2000;
  double greatest = 0;
  View last = from;
  std::vector<double> ways;
  for (int i = 1; i <= steps; ++i) {
    const View v = flight.at(end_s * i / steps);
    ASSERT_TRUE(std::isfinite(glm::length(v.position_m)) && std::abs(glm::length(v.orientation) - 1) < 1e-9) << what << " " << i;
    ASSERT_GE(glm::length(v.position_m), lowest_m * (1 - 1e-12)) << what << " " << i;
    // The way in heights: what the eye sees. It changes slowly from step to step, at the ends too.
    const double height_m = glm::length(v.position_m) - kEarth_m + 30;
    const double turn = 2 * std::acos(std::min(1.0, std::abs(glm::dot(v.orientation, last.orientation))));
    ways.push_back(glm::length(v.position_m - last.position_m) / height_m + turn);
    greatest = std::max(greatest, ways.back());
    last = v;
  }
  EXPECT_LT(greatest, 0.2) << what;
  EXPECT_LT(ways.front(), 1e-3 * greatest + 1e-6) << what;  // at rest at both ends; rounding of positions near the ground
  EXPECT_LT(ways.back(), 1e-3 * greatest + 1e-6) << what;
  for (std::size_t i = 1; i < ways.size(); ++i) ASSERT_LT(std::abs(ways[i] - ways[i - 1]), 0.03 * greatest + 1e-6) << what << " " << i;
}

TEST(ViewFlight, AnyTwoViews) {
  test::Random32 random(11);
  for (int i = 0; i < 60; ++i) expectGoodFlight(anyView(random), anyView(random), std::to_string(i));
}

TEST(ViewFlight, SpecialPairs) {
  const View zurich = toView(geographic(47.4, 8.5, 2), kEarth_m);
  const View above = toView(geographic(47.4, 8.5, 4e5), kEarth_m);
  const View besides = toView(geographic(47.4, 8.5 + 1e-9, 2), kEarth_m);
  View opposite = zurich;
  opposite.position_m = -opposite.position_m;
  const View north = toView(geographic(90, 0, 1000), kEarth_m), south = toView(geographic(-90, 0, 1e10), kEarth_m);
  View negative = zurich;
  negative.orientation = -negative.orientation;  // the same orientation
  expectGoodFlight(zurich, zurich, "same");
  expectGoodFlight(zurich, negative, "same, other sign");
  expectGoodFlight(zurich, above, "up");
  expectGoodFlight(above, zurich, "down");
  expectGoodFlight(zurich, besides, "a tenth of a millimetre");
  expectGoodFlight(zurich, opposite, "antipodes");
  expectGoodFlight(north, south, "pole to pole");
  EXPECT_NEAR(ViewFlight(zurich, negative, kEarth_m).duration_s(), ViewFlight(zurich, zurich, kEarth_m).duration_s(), 1e-9);
}

TEST(ViewFlight, ALongWayGoesOverTheTop) {
  const View from = toView(geographic(0, 0, 100), kEarth_m);
  const View to = toView(geographic(0, 9, 100), kEarth_m);  // 1000 km
  const ViewFlight flight(from, to, kEarth_m);
  const View middle = flight.at(flight.duration_s() / 2);
  EXPECT_NEAR(glm::length(middle.position_m) - kEarth_m, 0.32 * 999'000, 3000);  // rho^2 / 2 of the way
  EXPECT_NEAR(toGeographic(middle, kEarth_m).longitude_deg, 4.5, 1e-6);
  EXPECT_NEAR(toGeographic(middle, kEarth_m).pitch_deg, 0, 1e-6);  // still level with the horizon
}

TEST(ViewFlight, TheCameraFliesItAndAKeyEndsIt) {
  FlyCamera camera(kEarth_m);
  ASSERT_TRUE(camera.setView(toView(geographic(0, 0, 1000, 20, -5), kEarth_m)));
  camera.goTo(46, 7, 3000);
  ASSERT_TRUE(camera.inFlight());
  for (int i = 0; i < 60 * 30 && camera.inFlight(); ++i) camera.advance({}, 1.0 / 60);
  EXPECT_FALSE(camera.moves());
  auto g = toGeographic(camera.view(), kEarth_m);
  EXPECT_NEAR(g.latitude_deg, 46, 1e-9);
  EXPECT_NEAR(g.longitude_deg, 7, 1e-9);
  EXPECT_NEAR(g.altitude_m, 3000, 1e-6);
  EXPECT_NEAR(g.heading_deg, 20, 1e-7);
  EXPECT_NEAR(g.pitch_deg, -5, 1e-7);
  camera.goTo(0, 0, 10);
  camera.advance({}, 1);
  camera.advance({.move = {0, 0, -1}}, 0.01);
  EXPECT_FALSE(camera.inFlight());
}

TEST(ViewFlight, AMovingCameraLeavesWithoutAJerk) {
  FlyCamera camera(kEarth_m);
  ASSERT_TRUE(camera.setView(toView(geographic(0, 0, 50'000, 20, -5), kEarth_m)));
  camera.advance({.move = {0, 0.2, -1}}, 1);
  const glm::dvec3 velocity = camera.velocity_m_s();
  const View start = camera.view(), target = toView(geographic(3, 4, 1000, 90, 0), kEarth_m);
  ASSERT_GT(glm::length(velocity), 10'000);
  camera.flyTo(target);
  EXPECT_EQ(camera.view().position_m, start.position_m);
  glm::dvec3 last = start.position_m, lastVelocity = velocity;
  const double dt_s = 1e-3;
  for (int i = 0; camera.inFlight(); ++i) {
    ASSERT_LT(i, 30'000);
    camera.advance({}, dt_s);
    const glm::dvec3 now = (camera.view().position_m - last) / dt_s;
    // Of a free camera's braking, 62 km/s2, and the flight's own acceleration, 1760 km/s2 at the most, twice that; to stop at once would be
    // 16,000.
    ASSERT_LT(glm::length(now - lastVelocity), 4'000'000 * dt_s) << i;
    if (i < 50) {
      ASSERT_LT(glm::length(now - velocity * std::exp(-(i + 0.5) * dt_s / kDriveTime_s)), 0.02 * glm::length(velocity)) << i;
    }
    last = camera.view().position_m;
    lastVelocity = now;
  }
  EXPECT_EQ(camera.view().position_m, target.position_m);
  EXPECT_LT(glm::length(lastVelocity), 100);
}

TEST(Geographic, ComesBack) {
  test::Random32 random(3);
  for (int i = 0; i < 500; ++i) {
    const View view = anyView(random), again = toView(toGeographic(view, kEarth_m), kEarth_m);
    EXPECT_LT(glm::length(again.position_m - view.position_m), 1e-14 * glm::length(view.position_m) * 10);
    EXPECT_NEAR(std::abs(glm::dot(again.orientation, view.orientation)), 1, 1e-13);
  }
  for (const double latitude : {-90.0, 90.0, 0.0, 12.5}) {
    for (const double pitch : {-90.0, 90.0, 0.0, 30.0}) {
      const View view = toView(geographic(latitude, 77, 10, 123, pitch), kEarth_m);
      const View again = toView(toGeographic(view, kEarth_m), kEarth_m);
      EXPECT_NEAR(std::abs(glm::dot(again.orientation, view.orientation)), 1, 1e-9) << latitude << " " << pitch;
    }
  }
  EXPECT_EQ(placeText(geographic(-7.126, 11)), "7.13 S 11.00 E");
  EXPECT_EQ(lengthText(1.5), "1.5 m");
  EXPECT_EQ(lengthText(999.9), "1.00 km");
  EXPECT_EQ(lengthText(123456), "123 km");
}

}  // namespace
}  // namespace welkin::app
