// The path tracer against a furnace, single scattering, second order by quadrature, and flat slabs solved by integral equation.
#include "welkin/reference/path_tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "flat_slab.h"
#include "media.h"
#include "welkin/reference/columns.h"
#include "welkin/reference/directions.h"
#include "welkin/reference/quadrature.h"
#include "welkin/reference/radiance.h"
#include "welkin/reference/single_scattering.h"

namespace welkin::reference {
namespace {

constexpr double kDisc_rad = 0.004675;
// With a few dozen batches Student's t passes 4 once in 2,000 draws (normal: 16,000). Seeds are fixed: a pass stays a pass.
constexpr double kSigmas = 4;
// Relative error of optical depths by three points a cell (cells.h) times optical depths of a few.
constexpr double kQuadrature = 3e-4;

double gaussSum(const std::function<double(double)>& f, double from, double to) {
  const auto g = [&](double x) { return glm::dvec3(f(x)); };
  return detail::panel<Kronrod15>(g, from, to).value.x;
}

TEST(Random, PhaseFunctionsAreSampledExactly) {
  Random random(5);
  const PathNumbers::Shift shift(random);
  for (const auto& [type, g] : {std::pair{PhaseType::Rayleigh, 0.0},
                                {PhaseType::HenyeyGreenstein, 0.8},
                                {PhaseType::HenyeyGreenstein, -0.6},
                                {PhaseType::HenyeyGreenstein, 0.0},
                                {PhaseType::CornetteShanks, 0.8},
                                {PhaseType::CornetteShanks, 0.0},
                                {PhaseType::Isotropic, 0.0}}) {
    constexpr int kBins = 40, kDraws = 40'000;
    std::array<int, kBins> counts{};
    for (int i = 0; i < kDraws; ++i) {
      PathNumbers numbers(shift, 0, random);
      for (int k = 0; k < PathNumbers::kLattice; ++k) numbers.next();  // past the lattice: independent draws
      ++counts[std::min(int((samplePhase(type, g, numbers) + 1) / 2 * kBins), kBins - 1)];
    }
    double chi2 = 0;
    int bins = 0;
    for (int b = 0; b < kBins; ++b) {
      const double from = -1 + 2.0 * b / kBins;
      const double expected = kDraws * 2 * kPi * gaussSum([&](double c) { return phase(type, g, c); }, from, from + 2.0 / kBins);
      chi2 += (counts[b] - expected) * (counts[b] - expected) / expected, ++bins;
    }
    // 39 degrees of freedom: mean 39, deviation 8.8; 80 is passed once in 10,000.
    EXPECT_LT(chi2, 80) << int(type) << " " << g;
  }
}

TEST(Random, DirectionsKeepTheirAngle) {
  Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const double z = 2 * random.unit() - 1, a = 2 * kPi * random.unit(), s = std::sqrt(1 - z * z), c = 2 * random.unit() - 1;
    const glm::dvec3 axis(s * std::cos(a), s * std::sin(a), i == 0 ? -1 : z);
    const glm::dvec3 unit = glm::normalize(axis), to = directionAbout(unit, c, random.unit());
    EXPECT_NEAR(glm::dot(unit, to), c, 1e-14);
    EXPECT_NEAR(glm::length(to), 1, 1e-15);
  }
}

TEST(Cells, AgreeWithAdaptiveColumns) {
  const Medium medium = earth();
  const auto altitudes = cellAltitudes(medium);
  EXPECT_LT(altitudes.size(), 60u);
  Random random(8);
  std::vector<double> scratch;
  for (int i = 0; i < 2000; ++i) {
    const double h = 1e5 * std::pow(random.unit(), 3), mu = std::pow(2 * random.unit() - 1, 3);  // most of them low and grazing
    const auto depth = opticalDepthToTop(medium, h, mu);
    if (!depth) {
      EXPECT_EQ(quickTransmittance(medium, altitudes, h, mu, scratch), Spectrum(0));
      continue;
    }
    const Spectrum quick = -glm::log(quickTransmittance(medium, altitudes, h, mu, scratch));
    for (int k = 0; k < 3; ++k)
      if ((*depth)[k] < 500) {                                           // as transmittance it underflows
        EXPECT_NEAR(quick[k] / (*depth)[k], 1, 1e-4) << h << " " << mu;  // 8e-5 about the lowest point (cells.h)
      }
  }
}

TEST(PathTracer, FurnaceIsWhite) {
  // White air over white ground, a radiance of 1 from all around: 1 everywhere, whatever the phase functions and however thick.
  const auto white = [](double R, double thickness) {
    const double top = R / 64;
    return mediumOf(
        R, top,
        {{"e", ExponentialProfile{top / 12}, {0.3 * thickness / top, thickness / top, 12 * thickness / top}, {}, PhaseType::Rayleigh, 0},
         {"t", TentProfile{top / 4, top / 6}, {thickness / top, 0, thickness / top}, {}, PhaseType::CornetteShanks, 0.7},
         {"u", UniformProfile{0.3 * top, top / 2}, {0, thickness / top, 0}, {}, PhaseType::HenyeyGreenstein, -0.4}},
        {1, 1, 1});
  };
  for (const auto& [R, thickness] : {std::pair{100.0, 5.0}, {6.36e6, 0.5}}) {
    const Medium medium = white(R, thickness);
    const PathTracer tracer(medium);
    for (const auto& [h, view] : {std::pair{0.0, 20.0}, {0.0, 89.0}, {0.001, 94.0}, {0.5, 120.0}, {1.5, 150.0}, {1.5, 99.5}}) {
      PathSettings settings;
      settings.light = Light::Everywhere;
      settings.maxPaths = 9000;
      const auto lit = enterShell(medium, probeRay(h * R / 64, 60, view, 0));
      ASSERT_TRUE(lit);
      const Estimate e = tracer.estimate(*lit, settings);
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(e.mean[k], 1, kSigmas * e.standardError[k] + kQuadrature)
            << R << " " << thickness << " " << h << " " << view << " " << k;
        EXPECT_LT(e.standardError[k], 0.02);  // and says something
      }
    }
  }
}

TEST(PathTracer, FirstOrderIsSingleScattering) {
  for (const double disc_rad : {0.0, kDisc_rad}) {
    const Medium medium = earth(disc_rad);
    const PathTracer tracer(medium);
    for (const auto& [h, sun, view, azimuth] :
         {std::array{0.0, 40.0, 60.0, 20.0}, std::array{2.0, 89.8, 88.0, 10.0}, std::array{0.0, 94.0, 70.0, 0.0},
          std::array{9000.0, 91.0, 95.0, 40.0}, std::array{400'000.0, 80.0, 120.0, 90.0}, std::array{400'000.0, 96.0, 109.0, 170.0}}) {
      const auto lit = enterShell(medium, probeRay(h, sun, view, azimuth));
      ASSERT_TRUE(lit);
      PathSettings settings;
      settings.withFirstOrder = true, settings.maxOrders = 1;
      settings.maxPaths = 30'000;
      const Estimate e = tracer.estimate(*lit, settings);
      const Spectrum once = singleScattering(medium, *lit).radiance;
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(e.mean[k], once[k], kSigmas * e.standardError[k] + kQuadrature * once[k]) << sun << " " << view << " " << k;
        EXPECT_LE(e.standardError[k], 0.02 * once[k]);
      }
    }
  }
}

// Light of exactly two events by quadrature, the second event's light being single scattering: sphere, twilight and phase functions at
// once.
Spectrum secondOrder(const Medium& medium, const LitRay& lit) {
  const auto gathered = [&](const glm::dvec3& up, double h, const std::function<Spectrum(const glm::dvec3&)>& weight) {
    const double muSun = glm::dot(up, lit.toSun);
    const glm::dvec3 side = glm::normalize(lit.toSun - up * muSun), other = glm::cross(up, side);
    const double horizon = kPi / 2 + std::acos(medium.radius_m / (medium.radius_m + h));
    // Zenith angles as horizon -+ x^2: radiance has a root there. Azimuths over the whole circle.
    Spectrum sum{};
    for (const bool above : {true, false}) {
      if (!above && h == 0) continue;
      const double most = std::sqrt(above ? horizon : kPi - horizon);
      const auto ring = [&](double x) {
        const double zenith = above ? horizon - x * x : horizon + x * x;
        Spectrum around{};
        constexpr int kTurns = 8;  // on either side of the sun's plane, to which radiance is symmetric
        for (int i = 0; i < kTurns; ++i) {
          const double turn = kPi * (i + 0.5) / kTurns;
          const Spectrum radiance = spectrum(singleOrderRadiance(medium, {h, std::acos(muSun), zenith, turn}).radiance);
          for (const double side_ : {-1.0, 1.0}) {
            const glm::dvec3 to = up * std::cos(zenith) + (side * std::cos(turn) + other * (side_ * std::sin(turn))) * std::sin(zenith);
            around += radiance * weight(to) * (kPi / kTurns);
          }
        }
        return around * (2 * x * std::sin(zenith));
      };
      sum += detail::panel<Kronrod15>(ring, 0, most).value;
    }
    return sum;
  };
  const double r = lit.ray.startRadius_m();
  const auto along = [&](double x) {  // t = length x^2: densely at the start
    const double t = lit.length_m * x * x, h = lit.ray.altitudeAt(t);
    const glm::dvec3 up = glm::normalize(lit.up * r + lit.direction * t);
    const auto weight = [&](const glm::dvec3& to) { return scatteringTowards(medium, h, glm::dot(to, lit.direction)); };
    return glm::exp(-opticalDepth(medium, lit.ray, 0, t)) * gathered(up, h, weight) * (2 * lit.length_m * x);
  };
  Spectrum sum = detail::panel<Kronrod15>(along, 0, 1).value;
  if (lit.end == RayEnd::Ground) {
    const glm::dvec3 up = glm::normalize(lit.up * r + lit.direction * lit.length_m);
    const auto weight = [&](const glm::dvec3& to) { return medium.albedo / kPi * glm::dot(to, up); };
    sum += glm::exp(-opticalDepth(medium, lit.ray, 0, lit.length_m)) * gathered(up, 0, weight);
  }
  return sum;
}

TEST(PathTracer, SecondOrderIsAnIntegralOverSingleScattering) {
  const Medium medium =
      mediumOf(6.36e6, 80'000,
               {{"rayleigh", ExponentialProfile{8000}, {5.8e-6, 13.6e-6, 33.1e-6}, {}, PhaseType::Rayleigh, 0},
                {"haze", ExponentialProfile{3000}, {8e-6, 4e-6, 2e-6}, {1e-6, 1e-6, 1e-6}, PhaseType::HenyeyGreenstein, 0.3}},
               {0.1, 0.4, 0.9});
  const PathTracer tracer(medium);
  for (const auto& [h, sun, view, azimuth] : {std::array{0.0, 93.0, 60.0, 40.0}, std::array{9000.0, 70.0, 130.0, 90.0}}) {
    const auto lit = enterShell(medium, probeRay(h, sun, view, azimuth));
    ASSERT_TRUE(lit);
    PathSettings settings;
    settings.maxOrders = 2;
    const Estimate e = tracer.estimate(*lit, settings);
    const Spectrum twice = secondOrder(medium, *lit);
    // 15 rings and 16 azimuths: doubling either changes the sums by less than 0.3 %.
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(e.mean[k] / twice[k], 1, kSigmas * e.standardError[k] / twice[k] + 3e-3) << sun << " " << k;
  }
}

TEST(PathTracer, AllOrdersOfAFlatSlab) {
  // Wavelengths: conservative over black, absorbing over grey, thick and nearly white over white.
  const double thickness = 1000, R = 1e9;
  const std::array<double, 3> depth{1, 0.5, 4}, albedo{1, 0.7, 0.97};
  const Spectrum3 ground{0, 0.4, 1};
  AirLayer layer{"slab", UniformProfile{0, thickness}, {}, {}, PhaseType::Isotropic, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    layer.scattering_per_m[k] = albedo[k] * depth[k] / thickness;
    layer.absorption_per_m[k] = (1 - albedo[k]) * depth[k] / thickness;
  }
  const Medium medium = mediumOf(R, thickness, {layer}, ground);
  const PathTracer tracer(medium);
  PathSettings settings;
  settings.relativeError = 0.006;
  for (const double sun_deg : {20.0, 75.0})
    for (const auto& [h, view_deg] : {std::pair{0.0, 50.0}, {thickness, 115.0}}) {
      const ProbeResult result = radiance(medium, tracer, probeRay(h, sun_deg, view_deg, 40), settings);
      for (std::size_t k = 0; k < 3; ++k) {
        const FlatSlab slab(depth[k], albedo[k], ground[k], std::cos(sun_deg * kDeg));
        const double mu = std::abs(std::cos(view_deg * kDeg)), truth = h > 0 ? slab.up(mu) : slab.down(mu);
        // 300 cells err by 2e-4 (150 by 8e-4); the planet's curvature by 5e-5
        EXPECT_NEAR(result.radiance[k] / truth, 1, kSigmas * result.standardError[k] / truth + 3e-4)
            << sun_deg << " " << view_deg << " " << k;
        EXPECT_LE(result.standardError[k], 0.006 * result.radiance[k]);
      }
    }
}

TEST(PathTracer, RepeatsItselfForAnyThreads) {
  const Medium medium = earth(kDisc_rad);
  const PathTracer tracer(medium);
  const auto lit = enterShell(medium, probeRay(0, 80, 70, 30));
  PathSettings settings;
  settings.maxPaths = 10'000;
  const Estimate one = tracer.estimate(*lit, settings);
  settings.threads = 2;
  const Estimate two = tracer.estimate(*lit, settings);
  EXPECT_EQ(one.mean, two.mean);
  EXPECT_EQ(one.standardError, two.standardError);
  settings.seed = 2;
  const Estimate other = tracer.estimate(*lit, settings);
  EXPECT_NE(one.mean, other.mean);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(one.mean[k], other.mean[k], kSigmas * std::hypot(one.standardError[k], other.standardError[k]));
}

TEST(PathTracer, StandardErrorsAreWhatTheySay) {
  // 25 independent estimates of 24 batches: their spread is the standard error that they claim, to 14 % (one sigma of 25).
  const Medium medium = earth(kDisc_rad);
  const PathTracer tracer(medium);
  const auto lit = enterShell(medium, probeRay(0, 93, 60, 30));
  PathSettings settings;
  settings.maxPaths = 1;  // one round
  Spectrum sum{}, squares{}, claimed{};
  const int n = 25;
  for (int i = 0; i < n; ++i) {
    settings.seed = 100 + std::uint64_t(i);
    const Estimate e = tracer.estimate(*lit, settings);
    sum += e.mean, squares += e.mean * e.mean, claimed += e.standardError * e.standardError;
  }
  const Spectrum variance = (squares / double(n) - sum * sum / double(n * n)) * (double(n) / (n - 1));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(std::sqrt(variance[k] / (claimed[k] / n)), 1, 4 * 0.14);
}

TEST(PathTracer, OrdersAddUpToAll) {
  const Medium medium = earth(0, {0.3, 0.3, 0.3});
  const PathTracer tracer(medium);
  const auto lit = enterShell(medium, probeRay(0, 60, 75, 30));
  PathSettings settings;
  settings.maxPaths = 40'000;
  Spectrum last{};
  for (const int orders : {2, 3, 5, 0}) {
    settings.maxOrders = orders;
    const Estimate e = tracer.estimate(*lit, settings);
    for (int k = 0; k < 3; ++k) EXPECT_GT(e.mean[k], last[k]) << orders;
    last = e.mean;
  }
}

TEST(PathTracer, NeverNanNorNegative) {
  for (const double R : {100.0, 1e8})
    for (const double strength : {0.0, 10.0}) {
      const double top = R * 0.015, s = strength / top;
      const Medium medium = mediumOf(R, top,
                                     {{"e", ExponentialProfile{top / 12}, {s, 0, 5 * s}, {0, s, s}, PhaseType::CornetteShanks, 0.95},
                                      {"u", UniformProfile{top / 9, top / 5}, {0, 0, s}, {}, PhaseType::Rayleigh, 0}},
                                     {0.5, 1, 0}, kDisc_rad);
      const PathTracer tracer(medium);
      PathSettings settings;
      settings.maxPaths = 1;
      for (const double h : {0.0, 2 * R})
        for (const double sun : {0.0, 90.0, 180.0})
          for (const double view : {0.0, 90.0, 180.0}) {
            const auto lit = enterShell(medium, probeRay(h, sun, view, 180));
            if (!lit) continue;
            const Estimate e = tracer.estimate(*lit, settings);
            for (int k = 0; k < 3; ++k)
              EXPECT_TRUE(std::isfinite(e.mean[k]) && e.mean[k] >= 0 && std::isfinite(e.standardError[k]))
                  << R << " " << h << " " << sun << " " << view;
          }
    }
}

}  // namespace
}  // namespace welkin::reference
