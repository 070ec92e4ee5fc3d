#include "welkin/app/fly_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "random32.h"
#include "welkin/app/geographic.h"

namespace welkin::app {
namespace {

constexpr double kEarth_m = 6'360'000, kRad = std::numbers::pi / 180;

GeographicView geographic(double latitude_deg, double longitude_deg, double altitude_m = 2, double heading_deg = 0, double pitch_deg = 0,
                          double roll_deg = 0, double fov_deg = 58) {
  return {latitude_deg, longitude_deg, altitude_m, heading_deg, pitch_deg, roll_deg, fov_deg, {}};
}

double between(test::Random32& random, double low, double high) { return low + (high - low) * (random() / 4294967296.0); }

glm::dquat anyOrientation(test::Random32& random) {
  glm::dquat q;
  do q = glm::dquat(between(random, -1, 1), between(random, -1, 1), between(random, -1, 1), between(random, -1, 1));
  while (glm::length(q) < 0.1);
  return glm::normalize(q);
}

View anyView(test::Random32& random, double least_m = 2, double most_m = 1e8) {
  const double altitude_m = std::exp(between(random, std::log(least_m), std::log(most_m)));
  View view;
  view.position_m = directionTo(between(random, -90, 90), between(random, -180, 180)) * (kEarth_m + altitude_m);
  view.orientation = anyOrientation(random);
  return view;
}

FlyCamera cameraAt(double altitude_m, double pitch_deg = 0, double heading_deg = 30) {
  FlyCamera camera(kEarth_m);
  EXPECT_TRUE(camera.setView(toView(geographic(47, 8, altitude_m, heading_deg, pitch_deg), kEarth_m)));
  return camera;
}

bool finite(const View& v) {
  const auto& [x, y, z] = std::tie(v.position_m.x, v.position_m.y, v.position_m.z);
  return std::isfinite(x) && std::isfinite(y) && std::isfinite(z) && std::abs(glm::length(v.orientation) - 1) < 1e-9 && v.fov_deg > 0;
}

double angleBetween(const glm::dquat& a, const glm::dquat& b) {
  const glm::dquat d = glm::conjugate(a) * b;
  return 2 * std::asin(std::min(1.0, std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z)));
}

TEST(FlyCamera, OrbitToGroundTakesHalfAMinuteUntouched) {
  FlyCamera camera = cameraAt(400'000, -90);
  double time_s = 0;
  for (; camera.height_m() > 2 && time_s < 60; time_s += 1.0 / 60) camera.advance({.move = {0, 0, -1}}, 1.0 / 60);
  EXPECT_NEAR(time_s, 30, 1);  // and the quarter of a second that it takes to be under way
  for (int i = 0; i < 600; ++i) camera.advance({.move = {0, 0, -1}}, 1.0 / 60);
  EXPECT_NEAR(camera.altitude_m(), kEyeHeight_m, 1e-8);  // rounding of the planet's radius
  EXPECT_NEAR(glm::length(camera.velocity_m_s()), 0, 1e-6);
}

TEST(FlyCamera, AltitudeFollowsItsClosedForm) {
  FlyCamera camera = cameraAt(10'000);
  camera.advance({.move = {0, -1, 0}}, 7.3);
  const double way_s = 7.3 - kDriveTime_s * (1 - std::exp(-7.3 / kDriveTime_s));
  // 1e-8 m: rounding of positions 6000 km from the centre, in 468 pieces.
  EXPECT_NEAR(camera.height_m(), (10'000 + kGroundScale_m) * std::exp(-kSpeed_per_s * way_s) - kGroundScale_m, 1e-7);
}

// One step, the same in a thousand, and in between: the state after it does not know how time was cut.
TEST(FlyCamera, AnyFrameRateGivesTheSameFlight) {
  test::Random32 random(1);
  for (int round = 0; round < 40; ++round) {
    const View start = anyView(random, 5, 1e7);
    const double dt_s = std::exp(between(random, std::log(1e-6), std::log(10.0)));
    const bool rolls = round % 4 == 3;
    FlyInput first{.move = {between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)}}, second = first;
    second.move = {between(random, -1, 1), between(random, 0, 1), between(random, -1, 1)};
    first.level = second.level = rolls;
    if (rolls) second.roll = between(random, -1, 1);
    const auto flown = [&](int steps) {
      FlyCamera camera(kEarth_m);
      EXPECT_TRUE(camera.setView(start));
      camera.advance(first, 0.3);  // so that it moves, another way
      for (int i = 0; i < steps; ++i) camera.advance(second, dt_s / steps);
      return camera;
    };
    const FlyCamera once = flown(1), often = flown(1000);
    const double way_m = std::max(1.0, glm::length(once.velocity_m_s()) * dt_s);
    // Without a roll the method is of fourth order: 1e-8 of the way. A roll turns the keys' directions during a piece: second order.
    const double tolerance = rolls ? 3e-4 : 1e-8;
    EXPECT_LT(glm::length(once.view().position_m - often.view().position_m), tolerance * way_m + 1e-5) << round << " " << dt_s;
    EXPECT_LT(angleBetween(once.view().orientation, often.view().orientation), tolerance + 1e-7) << round << " " << dt_s;
    EXPECT_LT(glm::length(once.velocity_m_s() - often.velocity_m_s()), (tolerance + 1e-8) * glm::length(once.velocity_m_s()) + 1e-6);
  }
}

TEST(FlyCamera, SpeedComesAndGoesSmoothly) {
  FlyCamera camera = cameraAt(1000);
  double last = 0;
  for (int i = 0; i < 120; ++i) {
    camera.advance({.move = {0, 0, -1}}, 1.0 / 120);
    const double speed = glm::length(camera.velocity_m_s());
    EXPECT_GE(speed, last * (1 - 1e-6));
    EXPECT_LT(speed - last, kSpeed_per_s * 1030 * (1.0 / 120) / kDriveTime_s * 1.01);
    last = speed;
  }
  EXPECT_NEAR(last, kSpeed_per_s * 1030, kSpeed_per_s * 1030 * 0.03);  // 1 - exp(-4), and the height of the curve
  for (int i = 0; i < 120 * 8; ++i) camera.advance({}, 1.0 / 120);
  EXPECT_EQ(glm::length(camera.velocity_m_s()), 0);
  EXPECT_FALSE(camera.moves());
}

TEST(FlyCamera, ForwardFollowsTheCurveAllAroundThePlanet) {
  FlyCamera camera = cameraAt(400'000);
  const View start = camera.view();
  camera.speedFactor = 8;
  double turned = 0;
  glm::dvec3 last = start.position_m;
  for (int i = 0; i < 100'000 && turned < 2 * std::numbers::pi; ++i) {
    camera.advance({.move = {0, 0, -1}}, 1.0 / 60);
    turned += std::acos(std::min(1.0, glm::dot(glm::normalize(last), glm::normalize(camera.view().position_m))));
    last = camera.view().position_m;
    ASSERT_NEAR(camera.altitude_m(), 400'000, 1);  // level flight stays level, over the poles too
    ASSERT_NEAR(toGeographic(camera.view(), kEarth_m).pitch_deg, 0, 1e-6);
  }
  EXPECT_GE(turned, 2 * std::numbers::pi);
  EXPECT_LT(glm::length(camera.view().position_m - start.position_m), 0.003 * 2 * std::numbers::pi * kEarth_m);  // back, to a frame's way
}

TEST(FlyCamera, NeverBelowTheGroundAndNeverNotANumber) {
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    test::Random32 random(seed);
    for (const double radius_m : {1.0, 1000.0, kEarth_m, 1e9}) {
      FlyCamera camera(radius_m);
      if (seed == 3) camera.setGround([&](const glm::dvec3& d) { return 0.01 * radius_m * (1 + std::sin(50 * d.x) * std::cos(40 * d.y)); });
      for (int i = 0; i < 3000; ++i) {
        FlyInput in;
        in.move = {between(random, -2, 2), between(random, -2, 2), between(random, -2, 2)};
        in.turn_rad = {between(random, -1, 1), between(random, -1, 1)};
        in.roll = between(random, -1, 1);
        in.wheel = between(random, -3, 3);
        in.fast = random() % 2 != 0u;
        in.level = random() % 4 != 0u;
        if (random() % 50 == 0) in.move.x = std::nan("");
        if (random() % 50 == 0) in.turn_rad.y = INFINITY;
        camera.advance(in, random() % 100 == 0 ? between(random, -1, 100) : between(random, 0, 0.1));
        if (random() % 100 == 0) camera.grab(directionThrough(camera.view(), {between(random, -1, 1), between(random, -1, 1)}, 1.7));
        if (random() % 10 == 0) camera.drag(directionThrough(camera.view(), {between(random, -1, 1), between(random, -1, 1)}, 1.7));
        if (random() % 100 == 0) camera.release();
        if (random() % 300 == 0) camera.goTo(between(random, -90, 90), between(random, -360, 360), std::exp(between(random, -1, 25)));
        ASSERT_TRUE(finite(camera.view())) << seed << " " << radius_m << " " << i;
        // 1e-15 of the radius is rounding
        ASSERT_GE(camera.height_m(), kEyeHeight_m - 4e-15 * radius_m) << seed << " " << radius_m << " " << i;
        ASSERT_LE(glm::length(camera.view().position_m), 1.0000001e12);
      }
    }
  }
}

TEST(FlyCamera, PolesCentreAndFarAway) {
  FlyCamera camera(kEarth_m);
  EXPECT_NEAR(camera.altitude_m(), kEyeHeight_m, 1e-8);  // the default view stands at the centre: out at the pole
  for (const glm::dvec3 p : {glm::dvec3(0, 0, kEarth_m + 100), glm::dvec3(0, 0, -kEarth_m - 100), glm::dvec3(1e-300, 0, 0), glm::dvec3(0),
                             glm::dvec3(1e10, 0, 0), glm::dvec3(0, 3, -1e12), glm::dvec3(1e300, 1e300, 0)}) {
    for (const bool level : {false, true}) {
      View view;
      view.position_m = p;
      view.orientation = toView(geographic(90, 40, 2, 0, -90), kEarth_m).orientation;
      ASSERT_TRUE(camera.setView(view));
      for (int i = 0; i < 200; ++i) {
        camera.advance({.move = {0.3, -0.2, -1}, .turn_rad = {0.01, -0.01}, .roll = 0.2, .level = level}, 1.0 / 60);
        ASSERT_TRUE(finite(camera.view()));
        ASSERT_GE(camera.height_m(), kEyeHeight_m - 1e-8);
      }
    }
  }
  const View before = camera.view();
  View bad = before;
  bad.position_m.x = std::nan("");
  EXPECT_FALSE(camera.setView(bad));
  bad = before;
  bad.orientation = {0, 0, 0, 0};
  EXPECT_FALSE(camera.setView(bad));
  EXPECT_EQ(camera.view().position_m, before.position_m);
}

TEST(FlyCamera, AGivenViewStaysToTheBitUntilSomeoneSteers) {
  test::Random32 random(5);
  for (int i = 0; i < 50; ++i) {
    const View given = anyView(random);
    FlyCamera camera(kEarth_m);
    ASSERT_TRUE(camera.setView(given));
    for (int frame = 0; frame < 10; ++frame) camera.advance({}, 0.02);
    EXPECT_EQ(camera.view().position_m, given.position_m);
    EXPECT_EQ(camera.view().orientation, given.orientation);
  }
}

TEST(FlyCamera, RollComesUpright) {
  FlyCamera camera(kEarth_m);
  ASSERT_TRUE(camera.setView(toView(geographic(0, 0, 5000, 0, -20, 170), kEarth_m)));
  camera.advance({.turn_rad = {0.001, 0}}, 1e-6);
  for (int i = 0; i < 600; ++i) camera.advance({}, 1.0 / 60);
  const auto g = toGeographic(camera.view(), kEarth_m);
  EXPECT_NEAR(g.roll_deg, 0, 1e-4);  // 170 exp(-10 cos^2 20 / 0.5) = 3.6e-6
  EXPECT_NEAR(g.pitch_deg, -20, 1e-3);
  camera.advance({.roll = 1}, 0.5);
  EXPECT_GT(toGeographic(camera.view(), kEarth_m).roll_deg, 10);  // clockwise, as in scene files
}

TEST(FlyCamera, TurningKeepsTheHorizonAndStopsAtTheZenith) {
  FlyCamera camera = cameraAt(100, 10, 350);
  camera.advance({.turn_rad = {20 * kRad, 15 * kRad}}, 0);
  auto g = toGeographic(camera.view(), kEarth_m);
  EXPECT_NEAR(g.heading_deg, 10, 1e-9);
  EXPECT_NEAR(g.pitch_deg, 25, 1e-9);
  EXPECT_NEAR(g.roll_deg, 0, 1e-9);
  camera.advance({.turn_rad = {0, 10}}, 0);
  EXPECT_NEAR(toGeographic(camera.view(), kEarth_m).pitch_deg, 90, 1e-5);
  camera.advance({.turn_rad = {0, -30 * kRad}}, 0);
  g = toGeographic(camera.view(), kEarth_m);
  EXPECT_NEAR(g.pitch_deg, 60, 1e-5);
  EXPECT_NEAR(g.heading_deg, 10, 1e-4);
}

TEST(FlyCamera, WheelChangesSpeed) {
  FlyCamera slow = cameraAt(1000), quick = cameraAt(1000);
  quick.advance({.wheel = 4}, 0);
  for (FlyCamera* camera : {&slow, &quick}) {
    for (int i = 0; i < 200; ++i) camera->advance({.move = {1, 0, 0}}, 0.01);
  }
  EXPECT_NEAR(glm::length(quick.velocity_m_s()) / glm::length(slow.velocity_m_s()), std::pow(kWheelFactor, 4), 1e-3);
}

TEST(FlyCamera, DraggedPointStaysUnderTheCursor) {
  test::Random32 random(7);
  int tried = 0;
  for (int i = 0; i < 2000 && tried < 200; ++i) {
    FlyCamera camera(kEarth_m);
    ASSERT_TRUE(camera.setView(anyView(random, 100, 1e8)));
    const auto ray = [&] { return directionThrough(camera.view(), {between(random, -1, 1), between(random, -1, 1)}, 1.6); };
    const auto hit = [&](const View& v, const glm::dvec3& direction) -> std::optional<glm::dvec3> {
      const glm::dvec3 d = v.orientation * direction;
      const double b = glm::dot(v.position_m, d), c = glm::dot(v.position_m, v.position_m) - kEarth_m * kEarth_m;
      if (b >= 0 || b * b - c < 0) return std::nullopt;
      return v.position_m + d * (-b - std::sqrt(b * b - c));
    };
    const glm::dvec3 from = ray(), to = ray();
    const auto point = hit(camera.view(), from);
    if (!point || !hit(camera.view(), to)) continue;
    ++tried;
    const double altitude_m = camera.altitude_m();
    ASSERT_TRUE(camera.grab(from));
    camera.drag(to);
    // 1e-3 m: the textbook root above, close to the limb, loses that much; 1e-7 m: rounding of the distance
    EXPECT_LT(glm::length(*hit(camera.view(), to) - *point), 1e-3 + 1e-3 * (glm::length(*point) < 1)) << i;
    EXPECT_NEAR(camera.altitude_m(), altitude_m, 1e-7 + 1e-15 * altitude_m);
  }
  EXPECT_EQ(tried, 200);
}

TEST(FlyCamera, DragGoesOnPastTheLimbAndNotIntoTheSky) {
  FlyCamera camera = cameraAt(10'000'000, -90);
  ASSERT_TRUE(camera.grab({0, 0, -1}));
  glm::dvec3 last = camera.view().position_m;
  for (int i = 1; i <= 200; ++i) {  // out of the disc, whose edge stands at 22.9 degrees: no jump there
    const double a = i * 0.25 * kRad;
    camera.drag({std::sin(a), 0, -std::cos(a)});
    ASSERT_TRUE(finite(camera.view()));
    EXPECT_LT(glm::length(camera.view().position_m - last), 0.2 * 16'360'000) << i;
    last = camera.view().position_m;
  }
  camera.drag({0, 0, 1});
  EXPECT_EQ(camera.view().position_m, last);
  camera.release();
  EXPECT_FALSE(camera.grab({0, 0, 1}));
}

}  // namespace
}  // namespace welkin::app
