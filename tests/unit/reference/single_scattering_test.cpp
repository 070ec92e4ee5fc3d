// The sun's disc and single scattering against closed forms and second methods.
#include "welkin/reference/single_scattering.h"

#include <gtest/gtest.h>

#include <cmath>

#include "media.h"
#include "welkin/reference/columns.h"
#include "welkin/reference/radiance.h"
#include "welkin/reference/sun.h"

namespace welkin::reference {
namespace {

constexpr double kDisc_rad = 0.004675;

TEST(Sun, VisiblePartOfTheDiscIsACirclesSegment) {
  // No air: what is left is the part above the horizon, on the ground a great circle, which is straight to a^2 = 2e-5.
  const Medium bare = mediumOf(6.36e6, 100'000, {{"none", ExponentialProfile{8000}, {}, {}, PhaseType::Isotropic, 0}}, {}, kDisc_rad);
  for (const double x : {-1.5, -0.999, -0.7, -0.2, 0.0, 0.3, 0.8, 0.999, 1.5}) {
    const double c = std::clamp(x, -1.0, 1.0), segment = 0.5 + (c * std::sqrt(1 - c * c) + std::asin(c)) / kPi;
    EXPECT_NEAR(sunTransmittance(bare, 0, std::cos(kPi / 2 - x * kDisc_rad)).y, segment, 2e-5) << x;
  }
  for (const double h : {10.0, 9000.0, 90'000.0}) EXPECT_NEAR(sunTransmittance(bare, h, 0.3).y, 1, 1e-8) << h;
  EXPECT_NEAR(sunOnGround(bare, 0.5).y, 0.5 * (1 - kDisc_rad * kDisc_rad / 4), 1e-7);  // mean cosine of a small cap
}

TEST(Sun, DiscIsTheMeanOverItsPoints) {
  const Medium air = earth(kDisc_rad);
  const Medium point = earth(0);
  for (const double altitude : {0.0, 12'000.0})
    for (const double theta_deg : {0.0, 0.1, 0.2679, 0.4, 50.0, 89.6, 90.1, 91.5, 93.4, 93.6}) {
      // Midpoints of 200 rings and 200 turns; a cut disc errs by the fraction of cells on its edge, 1/200 of the ring's cells: 5e-4.
      const double theta = theta_deg * kDeg;
      Spectrum sum{}, most{};
      const int n = 200;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const double half = std::sin(kDisc_rad / 2), cosine = 1 - 2 * half * half * (i + 0.5) / n, sine = std::sqrt(1 - cosine * cosine);
          const double mu = std::cos(theta) * cosine + std::sin(theta) * sine * std::cos(kPi * (j + 0.5) / n);
          const auto depth = j % 4 == 0 || theta_deg > 85 ? opticalDepthToTop(point, altitude, mu) : std::optional<Spectrum>(1e9);
          if (theta_deg <= 85 && j % 4 != 0) continue;
          const Spectrum t = depth ? glm::exp(-*depth) : Spectrum(0);
          sum += t * (theta_deg > 85 ? 1.0 : 4.0), most = glm::max(most, t);
        }
      const Spectrum mean = sum / double(n * n), disc = sunTransmittance(air, altitude, std::cos(theta));
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(disc[k], mean[k], 5e-4 * most[k]) << theta_deg << " " << k;
    }
}

TEST(ShellRay, TerminatorsAreWhereTheDiscTouchesTheHorizon) {
  for (const double a : {0.0, kDisc_rad, 0.1}) {
    const Medium medium = earth(a);
    int seen = 0;
    for (double sun = 80; sun <= 110; sun += 1.7)
      for (double view = 5; view < 180; view += 17)
        for (const double azimuth : {0.0, 50.0, 160.0}) {
          const auto lit = enterShell(medium, probeRay(30'000, sun, view, azimuth));
          if (!lit) continue;
          for (const double t : terminators(medium, *lit)) {
            const double h = lit->ray.altitudeAt(t), r = medium.radius_m + h;
            const double horizon = kPi / 2 + std::acos(medium.radius_m / r), centre = std::acos(lit->sunMuAt(t));
            const double off = std::abs(std::abs(centre - horizon) - a);
            // The other sheet of the cone stands before the sun's side of the planet: centre at the mirror image of the horizon
            const double mirrored = std::abs(std::abs(kPi - centre - horizon) - a);
            EXPECT_LT(std::min(off, mirrored), 1e-7) << sun << " " << view;  // acos near 1 loses half of the digits
            seen += off < 1e-7;
          }
        }
    EXPECT_GT(seen, 100);
  }
}

// A slab on a planet so large that it is nearly flat: 1 km on 1e9 m. Path lengths are off by tan^2(zenith) / 2e6 <= 4e-6, and verticals a
// few km apart by 3e-6.
constexpr double kFlat_m = 1e9, kThick_m = 1000;
Medium slab(Spectrum3 scattering, Spectrum3 absorption, Spectrum3 albedo) {
  return mediumOf(kFlat_m, kThick_m, {{"slab", UniformProfile{0, kThick_m}, scattering, absorption, PhaseType::Isotropic, 0}}, albedo);
}

TEST(SingleScattering, FlatSlabIsAClosedForm) {
  const Medium medium = slab({1e-4, 1e-3, 8e-3}, {1e-4, 0, 2e-3}, {0.1, 0.5, 1.0});
  for (const double sun_deg : {0.0, 40.0, 70.0})
    for (const double view_deg : {10.0, 45.0, 65.0}) {
      const double mu0 = std::cos(sun_deg * kDeg), mu = std::cos(view_deg * kDeg);
      const ProbeResult up = singleOrderRadiance(medium, probeRay(0, sun_deg, view_deg, 30));
      const ProbeResult down = singleOrderRadiance(medium, probeRay(kThick_m, sun_deg, 180 - view_deg, 30));
      for (std::size_t k = 0; k < 3; ++k) {
        const double tau = kThick_m * medium.layers[0].extinction[int(k)],
                     albedo = medium.layers[0].scattering[int(k)] / medium.layers[0].extinction[int(k)];
        const double diffuse = albedo / (4 * kPi) * mu0 / (mu0 - mu) * (std::exp(-tau / mu0) - std::exp(-tau / mu));
        const double both = 1 / mu + 1 / mu0;
        const double reflected =
            albedo / (4 * kPi) * mu0 / (mu0 + mu) * -std::expm1(-tau * both) + medium.albedo[int(k)] / kPi * mu0 * std::exp(-tau * both);
        const double tolerance = 1e-5 * (1 + tau);  // the slab's curvature over cos(70 degrees), times its depth
        EXPECT_NEAR(up.radiance[k] / diffuse, 1, tolerance) << sun_deg << " " << view_deg;
        EXPECT_NEAR(down.radiance[k] / reflected, 1, tolerance) << sun_deg << " " << view_deg;
        EXPECT_NEAR(up.transmittance[k] / std::exp(-tau / mu), 1, tolerance);
      }
    }
}

TEST(SingleScattering, PiecesOfARayAddUp) {
  // L(whole) = L(first piece) + T(first piece) L(from there on): an observer set down on the ray sees the rest.
  const Medium medium = earth(kDisc_rad);
  for (const double sun_deg : {30.0, 88.0, 91.0, 95.0})
    for (const double view_deg : {30.0, 88.0, 92.5, 94.0}) {
      const double h = 9000, R = medium.radius_m, d = 40'000;
      const ProbeRay whole = probeRay(h, sun_deg, view_deg, 35);
      ProbeRay first = whole;
      first.maxDistance_m = d;
      const auto lit = enterShell(medium, whole);
      ASSERT_TRUE(lit && lit->length_m > d);
      ProbeRay rest;
      rest.altitude_m = lit->ray.altitudeAt(d);
      const double r = R + rest.altitude_m, mu = (lit->ray.startRadius_m() * lit->ray.mu + d) / r, sunMu = lit->sunMuAt(d);
      rest.viewZenith_rad = std::acos(mu), rest.sunZenith_rad = std::acos(sunMu);
      rest.azimuth_rad = std::acos((lit->cosSun - mu * sunMu) / std::sqrt((1 - mu * mu) * (1 - sunMu * sunMu)));
      const auto a = singleOrderRadiance(medium, first), b = singleOrderRadiance(medium, rest), all = singleOrderRadiance(medium, whole);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(a.transmittance[k] * b.transmittance[k] / all.transmittance[k], 1, 1e-6);
        EXPECT_NEAR(a.radiance[k] + a.transmittance[k] * b.radiance[k], all.radiance[k], 1e-6 * all.radiance[k]);  // each to 1e-7
      }
    }
}

TEST(SingleScattering, IsAPlainSumInFineSteps) {
  // 200,000 midpoints, nothing adaptive. The terminator is met to a step: 1e-5 of the light at the most.
  const Medium medium = earth();
  for (const auto& [h, sun, view, azimuth] : {std::array{0.0, 60.0, 80.0, 20.0}, std::array{0.0, 94.0, 40.0, 0.0},
                                              std::array{100'000.0, 97.0, 98.0, 60.0}, std::array{9000.0, 85.0, 100.0, 120.0}}) {
    const auto lit = enterShell(medium, probeRay(h, sun, view, azimuth));
    ASSERT_TRUE(lit);
    const int n = 20'000;
    const double step = lit->length_m / n;
    Spectrum sum{}, depth{};
    for (int i = 0; i < n; ++i) {
      const double t = (i + 0.5) * step, altitude = lit->ray.altitudeAt(t);
      const Spectrum half = extinction(medium, altitude) * (0.5 * step);
      depth += half;
      if (const auto toSun = opticalDepthToTop(medium, altitude, lit->sunMuAt(t)))
        sum += glm::exp(-depth - *toSun) * scatteringTowards(medium, altitude, lit->cosSun) * step;
      depth += half;
    }
    if (lit->end == RayEnd::Ground) sum += glm::exp(-depth) * medium.albedo / kPi * sunOnGround(medium, lit->sunMuAt(lit->length_m));
    const Spectrum once = singleScattering(medium, *lit).radiance;
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(once[k] / sum[k], 1, 5e-5) << view << " " << k;
  }
}

TEST(SingleScattering, GroundAtOnesFeet) {
  const Medium medium = earth(kDisc_rad);
  const ProbeResult down = singleOrderRadiance(medium, probeRay(0, 50, 130, 0));
  const Spectrum sun = sunOnGround(medium, std::cos(50 * kDeg));
  for (int k = 0; k < 3; ++k) {
    EXPECT_DOUBLE_EQ(down.transmittance[k], 1);
    EXPECT_NEAR(down.radiance[k], medium.albedo[k] / kPi * sun[k], 1e-15);
  }
}

TEST(SingleScattering, NeverNanNorNegative) {
  // Azimuth 170: at 180 with sun and view at 90 the ray lies on the edge of the shadow all along, lit or not by rounding.
  for (const double R : {100.0, 6.36e6, 1e8})
    for (const double a : {0.0, kDisc_rad}) {
      if (a > 0 && R > 100) continue;  // takes ten times as long
      const double top = R * 0.015;
      const Medium medium = mediumOf(R, top,
                                     {{"e", ExponentialProfile{top / 12}, {5 / top, 1 / top, 50 / top}, {}, PhaseType::CornetteShanks, 0.9},
                                      {"u", UniformProfile{top / 9, top / 5}, {0, 3 / top, 0}, {1 / top, 0, 0}, PhaseType::Rayleigh, 0}},
                                     {0.5, 1, 0}, a);
      for (const double h : {-1.0, 1e-9 * R, 0.1 * top, top, 2 * R})
        for (const double sun : {0.0, 89.999, 90.0, 100.0, 180.0})
          for (const double view : {0.0, 89.9999, 90.0, 135.0, 180.0}) {
            const auto lit = enterShell(medium, probeRay(h, sun, view, 170));
            if (!lit) continue;
            const SingleScattering result = singleScattering(medium, *lit);
            EXPECT_TRUE(result.converged) << R << " " << h << " " << sun << " " << view;
            for (int k = 0; k < 3; ++k) {
              EXPECT_TRUE(std::isfinite(result.radiance[k]) && result.radiance[k] >= 0) << R << " " << h << " " << sun << " " << view;
              EXPECT_TRUE(result.transmittance[k] >= 0 && result.transmittance[k] <= 1);
            }
          }
    }
}

}  // namespace
}  // namespace welkin::reference
