#include "welkin/physics/air.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "welkin/shared/ground.glsl.h"
#include "welkin/shared/tonemap.glsl.h"

namespace welkin {
namespace {

using namespace shared;
constexpr double kPiD = std::numbers::pi;

Scene sceneWith(welkin::AirLayer layer, double top_m = 100'000) {
  Scene scene;
  scene.planet.radius_m = 6'360'000;
  scene.atmosphere = Atmosphere{top_m, "auto", {std::move(layer)}};
  scene.sun = Sun{};
  return scene;
}

AirBlock blockOf(welkin::AirLayer layer, double top_m = 100'000) {
  auto block = airBlock(sceneWith(std::move(layer), top_m));
  EXPECT_TRUE(block.ok());
  return *block;
}

// Integral over the sphere and of its cosine, in double: 200,000 midpoints err by less than 1e-5 for |g| <= 0.95.
template <class Phase>
std::pair<double, double> integral(Phase phase) {
  double sum = 0, first = 0;
  const int n = 200'000;
  for (int i = 0; i < n; ++i) {
    const double c = -1 + 2 * (i + 0.5) / n;
    const double p = phase(static_cast<float>(c)) * 2 * kPiD * 2 / n;
    sum += p, first += p * c;
  }
  return {sum, first};
}

TEST(Phase, IntegratesToOneOverTheSphere) {
  for (const float g : {-0.5f, 0.0f, 0.3f, 0.8f, 0.95f})
    for (const std::uint32_t type : {kPhaseRayleigh, kPhaseCornetteShanks, kPhaseHenyeyGreenstein, kPhaseIsotropic}) {
      const auto [sum, mean] = integral([&](float c) { return phaseValue(type, g, c); });
      EXPECT_NEAR(sum, 1, 2e-5) << "type " << type << " g " << g;  // the sum's own error, and floats
      if (type == kPhaseHenyeyGreenstein) {
        EXPECT_NEAR(mean, g, 2e-5);
      }
      // Cornette and Shanks' mean cosine: 3 g (4 + g^2) / (5 (2 + g^2)).
      if (type == kPhaseCornetteShanks) {
        EXPECT_NEAR(mean, 3 * g * (4 + g * g) / (5 * (2 + g * g)), 2e-5);
      }
    }
}

TEST(Air, VerticalColumnOfExponentialAir) {
  for (const double scale : {1200.0, 8000.0}) {
    const AirBlock air = blockOf({"air", ExponentialProfile{scale}, {1e-5, 2e-5, 4e-5}, {1e-6, 0, 0}, PhaseType::Rayleigh, 0});
    // 1200 m times the logarithm of 4e-5 / m times 223 km, the longest path at the ground, over 1e-8: 20.61
    EXPECT_NEAR(air.params.top_m, scale == 1200 ? 24'730 : 100'000, 10) << "where the longest path through the rest has a depth of 1e-8";
    for (const double h : {0.0, 500.0, 9000.0, 60'000.0}) {
      if (h > air.params.top_m) continue;
      const double column = scale * (std::exp(-h / scale) - std::exp(-air.params.top_m / scale));
      const glm::vec3 depth = airOpticalDepthToTop(air, static_cast<float>(h), 1, 40);
      // 40 two-point panels: the quadrature errs by less than 1e-4 here, floats by 1e-6
      EXPECT_NEAR(depth.x / (1.1e-5 * column), 1, 1e-4) << scale << " " << h;
      EXPECT_NEAR(depth.z / (4e-5 * column), 1, 1e-4);
    }
  }
}

TEST(Air, HorizontalColumnIsChapmans) {
  for (const double scale : {1200.0, 8000.0}) {
    const AirBlock air = blockOf({"air", ExponentialProfile{scale}, {1e-5, 1e-5, 1e-5}, {}, PhaseType::Rayleigh, 0});
    const double x = 6'360'000 / scale;
    // Chapman's function at 90 degrees, X e^X K1(X), by its asymptotic series (next term 1e-9); air above the top adds erfc(3.5) = 7e-7.
    const double chapman = std::sqrt(kPiD * x / 2) * (1 + 3 / (8 * x) - 15 / (128 * x * x));
    EXPECT_NEAR(airOpticalDepthToTop(air, 0, 0, 40).y / (1e-5 * scale * chapman), 1, 1e-4) << scale;
  }
}

TEST(Air, RayThatDescendsFirst) {
  const AirBlock air = blockOf({"air", ExponentialProfile{8000}, {1e-5, 1e-5, 1e-5}, {}, PhaseType::Rayleigh, 0});
  // From 30 km towards the lowest point at 5 km: the part below plus twice the rest is the whole chord from top to top.
  const float r = 6'390'000, lowest = 6'365'000;
  const float mu = -std::sqrt((r - lowest) * (r + lowest)) / r;
  const double down = airOpticalDepthToTop(air, 30'000, mu, 40).x, up = airOpticalDepthToTop(air, 30'000, -mu, 40).x;
  const double half = airOpticalDepthToTop(air, 5'000, 0, 40).x;
  EXPECT_NEAR((down + up) / (2 * half), 1, 2e-4);  // three quadratures
}

TEST(Air, UniformShellIsLengthTimesExtinction) {
  const AirBlock air = blockOf({"slab", UniformProfile{0, 100'000}, {1e-6, 1e-6, 1e-6}, {}, PhaseType::Isotropic, 0});
  for (const double h : {0.0, 2.0, 20'000.0, 99'000.0})
    for (const double mu : {1.0, 0.5, 0.01, 0.0}) {
      const double r = 6'360'000 + h, top = 6'460'000;
      const double length = -r * mu + std::sqrt(r * r * mu * mu + (top - r) * (top + r));
      EXPECT_NEAR(airOpticalDepthToTop(air, static_cast<float>(h), static_cast<float>(mu), 20).x / (1e-6 * length), 1, 1e-5)
          << h << " " << mu;
    }
}

TEST(Air, DistancesToGroundAndTop) {
  const AirBlock air = blockOf({"air", ExponentialProfile{8000}, {1e-5, 1e-5, 1e-5}, {}, PhaseType::Rayleigh, 0});
  for (const double h : {1.8, 100.0, 9000.0, 100'000.0})
    for (const double tilt : {1.0, 0.3, 1e-3, 1e-6}) {
      const double r = 6'360'000 + h, horizon = -std::sqrt(h * (2 * 6'360'000 + h)) / r;
      const double mu = static_cast<float>(horizon - tilt * (1 + horizon));
      const double truth = -r * mu - std::sqrt(r * r * mu * mu - h * (2 * 6'360'000 + h));
      // The root of a nearly zero discriminant magnifies rounding of b^2 (2^-23) by b^2 / (2 root), hence the second term.
      const double b = r * mu, root = std::sqrt(b * b - h * (2 * 6'360'000 + h));
      EXPECT_NEAR(distanceToGround(air.params, float(h), float(mu)), truth, truth * 1e-6 + b * b * 2.4e-7 / (root + 1)) << h << " " << tilt;
    }
}

TEST(Air, SunSetsOverItsOwnDiameter) {
  const AirBlock air = blockOf({"air", ExponentialProfile{8000}, {1e-5, 1e-5, 1e-5}, {}, PhaseType::Rayleigh, 0});
  for (const double h : {0.0, 1000.0, 100'000.0}) {
    const double horizon = std::acos(-std::sqrt(h * (2 * 6'360'000.0 + h)) / (6'360'000 + h));
    const double size = air.params.sunRadius_rad;
    const auto at = [&](double above) { return sunVisible(air.params, float(h), static_cast<float>(std::cos(horizon - above))); };
    EXPECT_FLOAT_EQ(at(1.01 * size), 1);
    EXPECT_FLOAT_EQ(at(-1.01 * size), 0);
    EXPECT_NEAR(at(0), 0.5, 1e-4);
    for (double x = -1; x <= 1; x += 0.1)  // the disc's true area; the fit differs by 3e-5, cosines of floats by 1.2e-7 over the sun's 0.0047 times a slope of 2/pi: 2e-5, and more
                                         // at 100 km where the cosine is of a steeper angle
      EXPECT_NEAR(at(x * size), 0.5 + (x * std::sqrt(std::max(1 - x * x, 0.0)) + std::asin(std::clamp(x, -1.0, 1.0))) / kPiD, 2e-4);
  }
}

TEST(Air, TableCoordinatesInvert) {
  const AirBlock air = blockOf({"air", ExponentialProfile{8000}, {1e-5, 1e-5, 1e-5}, {}, PhaseType::Rayleigh, 0});
  for (float y = 0; y <= 1; y += 0.0625f)
    for (float x = 0; x <= 1; x += 0.0625f) {
      const glm::vec2 point = transmittancePoint(air.params, {x, y});
      const glm::vec2 back = transmittanceCoord(air.params, point.x, point.y);
      // At the top the distance's own range starts at 0 and mu is flat in it: 1e-3 of the table is a quarter of a texel
      EXPECT_NEAR(back.x, x, 1e-3) << x << " " << y;
      EXPECT_NEAR(back.y, y, 1e-4);
    }
  for (float x = 0; x <= 1; x += 0.01f) EXPECT_NEAR(sunCoord(air.params, sunCosine(air.params, x)), x, 2e-6);
  for (const float w : {-1.0f, -0.4f, 0.0f, 0.5f, 0.98f})
    for (float x = 0; x <= 1; x += 0.01f) EXPECT_NEAR(airSliceOf(w, airSliceAt(w, x)), x, 1e-3);  // flat ends: square root of 2^-24
}

TEST(Air, ViewCoordinatesInvertAndMeetTheHorizon) {
  const AirBlock air = blockOf({"air", ExponentialProfile{8000}, {1e-5, 1e-5, 1e-5}, {}, PhaseType::Rayleigh, 0});
  for (const double h : {0.0, 2.0, 9000.0, 99'000.0, 400'000.0, 3e7}) {
    const AirViewFrame v = airViewFrame(air.params, 6'360'000 + h, h, {0, 0, 1}, {1, 0, 0});
    for (const bool ground : {false, true}) {
      EXPECT_NEAR(viewCoord(v, v.muHorizon, ground), 0, 1e-6);
      EXPECT_NEAR(viewCoord(v, ground ? -1.0f : h > 100'000 ? 0.0f : 1.0f, ground), 1, 1e-6);
      float last = v.muHorizon;
      for (float x = 0.02f; x <= 1; x += 0.02f) {
        const float mu = viewCosine(v, x, ground);
        EXPECT_TRUE(ground ? mu < last : mu > last) << "monotone " << h << " " << x;
        EXPECT_NEAR(viewCoord(v, mu, ground), x, 2e-3) << h;  // a fifth of a texel; mu itself is a float
        last = mu;
      }
    }
  }
}

TEST(Air, PeakIsTheStrongestSharpLayer) {
  Scene scene = sceneWith({"rayleigh", ExponentialProfile{8000}, {5e-6, 1e-5, 3e-5}, {}, PhaseType::Rayleigh, 0});
  EXPECT_EQ(airBlock(scene)->params.peakLayer, kNoLayer);
  scene.atmosphere->layers.push_back({"haze", ExponentialProfile{1200}, {1e-6, 1e-6, 1e-6}, {}, PhaseType::HenyeyGreenstein, 0.7});
  scene.atmosphere->layers.push_back({"dust", ExponentialProfile{3000}, {2e-6, 2e-6, 2e-6}, {}, PhaseType::CornetteShanks, 0.8});
  const auto block = airBlock(scene);
  EXPECT_EQ(block->params.peakLayer, 2u);
  EXPECT_EQ(block->params.peakPhase, kPhaseCornetteShanks);
  EXPECT_FLOAT_EQ(block->params.peakG, 0.8f);
}

TEST(Air, SaysWhatIsWrongInOneLine) {
  const auto message = [](welkin::AirLayer layer) {
    auto block = airBlock(sceneWith(std::move(layer)));
    return block.ok() ? std::string("accepted") : block.error().message;
  };
  EXPECT_EQ(message({"a", ExponentialProfile{0}, {}, {}, PhaseType::Rayleigh, 0}),
            "atmosphere layer 'a': scale_height_m must be greater than 0");
  EXPECT_EQ(message({"b", UniformProfile{5, 5}, {}, {}, PhaseType::Rayleigh, 0}),
            "atmosphere layer 'b': top_m must be greater than base_m");
  EXPECT_EQ(message({"c", TentProfile{5, 1}, {}, {}, PhaseType::Rayleigh, 1}), "atmosphere layer 'c': g must lie between -1 and 1");
  Scene scene;
  EXPECT_FALSE(airBlock(scene).ok());
}

TEST(Ground, LambertAndWaterStayBounded) {
  const glm::vec3 up(0, 0, 1);
  const glm::vec3 white = groundRadiance(glm::vec3(1), up, up, up, glm::vec3(1), glm::vec3(0));
  EXPECT_NEAR(white.x, 1 / kPiD, 1e-6);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto direction = [&] {
    const double z = unit(random), a = 2 * kPiD * unit(random), s = std::sqrt(1 - z * z);
    return glm::vec3(s * std::cos(a), s * std::sin(a), z);
  };
  for (int i = 0; i < 20'000; ++i) {
    const glm::vec3 l = groundRadiance(glm::vec3(0.02f, 0.03f, 0.08f), up, direction(), direction(), glm::vec3(1), glm::vec3(0.2f));
    EXPECT_TRUE(std::isfinite(l.x) && l.x >= 0 && l.x < 20) << l.x;
  }
  // Reflected energy of the glint never passes what arrives: sun at 45 degrees, integral of radiance * cosine over the hemisphere.
  double flux = 0;
  const glm::vec3 sun = glm::normalize(glm::vec3(1, 0, 1));
  const int n = 200'000;
  for (int i = 0; i < n; ++i) {
    const glm::vec3 v = direction();
    flux += waterGlint(up, sun, v) * v.z * 2 * kPiD / n;
  }
  EXPECT_GT(flux, 0.01);  // water reflects 2 to 5 % at these angles
  EXPECT_LT(flux, 0.05 * sun.z);
}

TEST(ToneMap, MonotoneBlackToWhite) {
  float last = -1;
  for (float x = 0; x < 20; x = x * 1.05f + 0.001f) {
    const float y = acesFilmic(glm::vec3(x)).y;
    EXPECT_GE(y, last);
    last = y;
  }
  EXPECT_NEAR(acesFilmic(glm::vec3(0)).x, 0, 1e-6);
  EXPECT_GT(acesFilmic(glm::vec3(1000)).x, 0.98f);
  // A thick sunlit cloud, as kBaseExposure promises.
  EXPECT_NEAR(srgbEncode(acesFilmic(glm::vec3(0.8f / 3.14159f * kBaseExposure)).y), 0.91, 0.01);
  double sum = 0;
  for (std::uint32_t i = 0; i < 100'000; ++i) {
    const float d = pixelDither(i % 317, i / 317);
    ASSERT_TRUE(d >= -0.5f && d <= 0.5f);
    sum += d;
  }
  EXPECT_NEAR(sum / 100'000, 0, 4 * 0.289 / std::sqrt(100'000.0));  // four standard errors of a uniform variable
}

}  // namespace
}  // namespace welkin
