// Geometry and columns against closed forms.
#include "welkin/reference/columns.h"

#include <gtest/gtest.h>

#include <cmath>

#include "media.h"
#include "welkin/reference/quadrature.h"
#include "welkin/reference/random.h"

namespace welkin::reference {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

TEST(Quadrature, IsExactForPolynomialsAndFindsAPeak) {
  // 15 Kronrod points integrate degree 22 exactly: to rounding.
  for (int degree = 0; degree <= 22; ++degree) {
    const auto f = [&](double x) { return glm::dvec3(std::pow(x, degree)); };
    EXPECT_NEAR(detail::panel<Kronrod15>(f, 0, 1).value.x * (degree + 1), 1, 1e-14) << degree;
  }
  const auto peak = [](double x) { return glm::dvec3(1e-3 / (1e-6 + (x - 0.3) * (x - 0.3)), std::sqrt(x), 0); };
  const Integral sum = integrate(peak, std::array{0.0, 1.0}, {1e-10, 0});
  EXPECT_TRUE(sum.converged);
  EXPECT_NEAR(sum.value.x, std::atan(700) + std::atan(300), 3e-10 * kPi);  // what was asked for
  EXPECT_NEAR(sum.value.y, 2.0 / 3, 1e-10);
  EXPECT_FALSE(integrate(peak, std::array{0.0, 1.0}, {1e-10, 0}, 4).converged);
}

TEST(ShellRay, AltitudesAgreeWithExtendedPrecision) {
  Random random(11);
  for (int i = 0; i < 20'000; ++i) {
    const double R = std::pow(10, 2 + 6 * random.unit()), h0 = R * std::pow(10, -8 * random.unit()),
                 t = R * std::pow(10, 1 - 9 * random.unit());
    const double mu = 2 * random.unit() - 1;
    const ShellRay ray{R, h0, mu, (R + h0) * std::sqrt(1 - mu * mu)};
    const long double r0 = (long double)R + h0, truth = std::sqrt(r0 * r0 + 2 * r0 * mu * t + (long double)t * t) - R;
    // Each term of the numerator, over about 2R, is at most h0 or t or t^2 / R and rounds a few times; the 64-bit form by 6e-20 R.
    EXPECT_NEAR(ray.altitudeAt(t), double(std::max(truth, 0.0L)), 6 * kEps * (h0 + t + t * t / (t + R)) + 1e-18 * R) << R << " " << h0;
  }
}

TEST(ShellRay, MeetsGroundTopAndLevels) {
  Random random(12);
  for (int i = 0; i < 20'000; ++i) {
    const double R = std::pow(10, 2 + 6 * random.unit());
    Medium medium;
    medium.radius_m = R, medium.top_m = R * std::pow(10, -4 * random.unit());
    const double h = medium.top_m * random.unit();
    const ShellRay ray = rayFrom(medium, h, 2 * random.unit() - 1);
    // An altitude is met to a few roundings of r^2 / 2R; dh/dt is at most 1.
    const double slack = 20 * kEps * (R + medium.top_m);
    const double top = distanceToTop(ray, medium.top_m);
    EXPECT_NEAR(ray.altitudeAt(top), medium.top_m, slack);
    const auto ground = distanceToGround(ray);
    EXPECT_EQ(ground.has_value(), ray.mu < 0 && ray.impact_m < R);
    if (ground) {
      EXPECT_NEAR(ray.altitudeAt(*ground), 0, slack);
      EXPECT_LT(*ground, top);
    }
    const double level = medium.top_m * random.unit();
    if (const auto both = ray.distancesTo(level)) {
      for (const double t : *both) EXPECT_NEAR(ray.altitudeAt(t), level, slack);
      EXPECT_LE((*both)[0], (*both)[1]);
    } else {
      EXPECT_GE(ray.impact_m, R + level);
    }
  }
}

TEST(ShellRay, EntersFromFarAwayWhereItEntersFromNear) {
  // One line in space, 10 km above the ground at its lowest, seen from 400 km and from 1e10 m; the sun is fixed in space.
  const Medium medium = earth();
  const double p = medium.radius_m + 10'000;
  const auto seen = [&](double altitude_m) {
    const double r = medium.radius_m + altitude_m, nadir = std::asin(p / r);  // the line runs along -x at z = p
    ProbeRay ray;
    ray.altitude_m = altitude_m, ray.viewZenith_rad = kPi - nadir;
    // Sun at 1 rad from +z towards +x. The observer's vertical is pi/2 - nadir from +z towards +x.
    ray.sunZenith_rad = std::abs(1 - (kPi / 2 - nadir));
    ray.azimuth_rad = 1 > kPi / 2 - nadir ? kPi : 0;
    return enterShell(medium, ray);
  };
  const auto near = seen(400'000), far = seen(1e10);
  ASSERT_TRUE(near && far);
  EXPECT_EQ(near->end, RayEnd::Space);
  // Angles near pi round by 4e-16: 4 µm at 1e10 m; the chord through the shell changes r / length times as much, the cosines by 1e-12.
  EXPECT_NEAR(far->ray.impact_m, p, 2e-5);
  EXPECT_NEAR(far->length_m, near->length_m, 1e-3);
  EXPECT_NEAR(far->sunMu, near->sunMu, 1e-10);
  EXPECT_NEAR(far->cosSun, near->cosSun, 1e-10);
}

TEST(ShellRay, EdgesAreDefined) {
  const Medium medium = earth();
  EXPECT_FALSE(enterShell(medium, probeRay(100'000, 30, 0, 0)));   // on top, looking up
  EXPECT_FALSE(enterShell(medium, probeRay(100'000, 30, 90, 0)));  // and along it
  EXPECT_TRUE(enterShell(medium, probeRay(100'000, 30, 90.001, 0)));
  EXPECT_FALSE(enterShell(medium, probeRay(1e7, 30, 120, 0)));  // past the shell
  const auto down = enterShell(medium, probeRay(0, 30, 120, 0));
  ASSERT_TRUE(down);
  EXPECT_EQ(down->end, RayEnd::Ground);
  EXPECT_EQ(down->length_m, 0);
  const auto below = enterShell(medium, probeRay(-500, 30, 60, 10)), onGround = enterShell(medium, probeRay(0, 30, 60, 10));
  ASSERT_TRUE(below && onGround);
  EXPECT_EQ(below->length_m, onGround->length_m);
  ProbeRay ends = probeRay(400'000, 30, 180, 0);
  ends.maxDistance_m = 299'000;  // before the air begins
  EXPECT_FALSE(enterShell(medium, ends));
  ends.maxDistance_m = 350'000;
  EXPECT_EQ(enterShell(medium, ends)->end, RayEnd::Distance);
  EXPECT_NEAR(enterShell(medium, ends)->length_m, 50'000, 1e-8);
}

TEST(Columns, VerticalColumnsAreClosedForms) {
  for (const double R : {100.0, 6.36e6, 1e8}) {  // straight up the radius does not matter
    const Medium air = mediumOf(R, 100'000,
                                {{"e", ExponentialProfile{8000}, {1e-5, 2e-5, 4e-5}, {1e-6, 0, 0}, PhaseType::Rayleigh, 0},
                                 {"t", TentProfile{25'000, 15'000}, {}, {0, 0, 1e-6}, PhaseType::Isotropic, 0},
                                 {"u", UniformProfile{3000, 4000}, {}, {0, 1e-4, 0}, PhaseType::Isotropic, 0}});
    for (const double h : {0.0, 500.0, 3200.0, 9000.0, 25'000.0, 60'000.0}) {
      const auto depth = opticalDepthToTop(air, h, 1);
      ASSERT_TRUE(depth);
      const double e = 8000 * (std::exp(-h / 8000) - std::exp(-12.5));
      const double x = (h - 25'000) / 15'000, tent = h <= 10'000  ? 15'000
                                                     : h < 25'000 ? 15'000 * (1 - 0.5 * (1 + x) * (1 + x))
                                                     : h < 40'000 ? 7500 * (1 - x) * (1 - x)
                                                                  : 0;
      const double slab = std::clamp(4000 - h, 0.0, 1000.0);
      const double tolerance = R < 1000 ? 1e-9 : 1e-10;  // the tolerance asked for; near a tiny planet r(t) rounds more
      EXPECT_NEAR(depth->x / (1.1e-5 * e), 1, tolerance) << h;
      EXPECT_NEAR(depth->y / (2e-5 * e + 1e-4 * slab), 1, tolerance) << h;
      EXPECT_NEAR(depth->z / (4e-5 * e + 1e-6 * tent), 1, tolerance) << h;
    }
  }
}

TEST(Columns, UniformShellIsLengthTimesExtinction) {
  const Medium air = mediumOf(6.36e6, 100'000, {{"u", UniformProfile{0, 100'000}, {1e-6, 1e-5, 1e-4}, {}, PhaseType::Isotropic, 0}});
  for (const double h : {0.0, 2.0, 20'000.0, 99'000.0})
    for (const double mu : {1.0, 0.5, 0.01, 0.0}) {
      const double r = 6.36e6 + h, length = -r * mu + std::sqrt(r * r * mu * mu + (6.46e6 - r) * (6.46e6 + r));
      const auto depth = opticalDepthToTop(air, h, mu);
      ASSERT_TRUE(depth);
      EXPECT_NEAR(depth->y / (1e-5 * length), 1, 1e-10);  // the textbook length cancels to 1e-16 * r / length
    }
}

TEST(Columns, HorizontalColumnIsChapmans) {
  // From radius R to infinity along the horizontal: n R e^X K1(X), X = R / H. The shell's top at 60 H leaves 1e-26 out.
  for (const double x : {10.0, 100.0, 600.0}) {
    const double H = 1000, R = x * H;
    const Medium air = mediumOf(R, 60 * H, {{"e", ExponentialProfile{H}, {1e-5, 1e-5, 1e-5}, {}, PhaseType::Rayleigh, 0}});
    const double chapman = R * std::exp(x) * std::cyl_bessel_k(1.0, x);
    EXPECT_NEAR(opticalDepthToTop(air, 0, 0)->x / (1e-5 * chapman), 1, 1e-9) << x;  // 1e-10, and the Bessel function's own 1e-10
    // A whole chord through the lowest point, from far out on both sides
    const double out = std::sqrt((R + 50 * H) * (R + 50 * H) - R * R);
    const ShellRay chord{R, 50 * H, -out / (R + 50 * H), R};
    EXPECT_NEAR(opticalDepth(air, chord, 0, 2 * out).x / (2e-5 * chapman), 1, 1e-9);
  }
}

TEST(Columns, ThinAirOnALargePlanetIsNotMissed) {
  // A scale height of 1 m below 10,000 km of nothing: the decay is found because rays are split at multiples of it.
  const Medium air = mediumOf(1e8, 1e7, {{"e", ExponentialProfile{1}, {1e-3, 1e-3, 1e-3}, {}, PhaseType::Rayleigh, 0}});
  EXPECT_NEAR(opticalDepthToTop(air, 0, 1)->x, 1e-3, 1e-12);
  EXPECT_NEAR(opticalDepthToTop(air, 0, 0.5)->x, 2e-3, 2e-10);  // curvature: H / R
}

TEST(Medium, PhaseFunctionsIntegrateToOne) {
  for (const double g : {-0.9, 0.0, 0.3, 0.8, 0.999})
    for (const PhaseType type : {PhaseType::Rayleigh, PhaseType::CornetteShanks, PhaseType::HenyeyGreenstein, PhaseType::Isotropic}) {
      const auto f = [&](double c) { return glm::dvec3(2 * kPi * phase(type, g, c)); };
      EXPECT_NEAR(integrate(f, std::array{-1.0, 0.0, 1.0}, {1e-10, 0}).value.x, 1, 1e-9) << int(type) << " " << g;
    }
}

TEST(Medium, SaysWhatIsWrong) {
  EXPECT_FALSE(makeMedium(Scene{}).ok());
  const auto message = [](AirLayer layer) { return makeMedium(sceneOf(1e6, 1e5, {std::move(layer)})).error().message; };
  EXPECT_EQ(message({"a", ExponentialProfile{0}, {}, {}, PhaseType::Rayleigh, 0}),
            "atmosphere layer 'a': scale_height_m must be greater than 0");
  EXPECT_EQ(message({"b", UniformProfile{5, 5}, {}, {}, PhaseType::Rayleigh, 0}),
            "atmosphere layer 'b': top_m must be greater than base_m");
  EXPECT_EQ(message({"c", TentProfile{5, 1}, {-1, 0, 0}, {}, PhaseType::Rayleigh, 0}),
            "atmosphere layer 'c': scattering_per_m and absorption_per_m must not be negative");
}

}  // namespace
}  // namespace welkin::reference
