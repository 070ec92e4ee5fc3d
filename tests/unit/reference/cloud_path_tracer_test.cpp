// All orders in cloud: furnace, Beer and Lambert, one order and all orders of a slab, and the clear air's own path tracer where there is no
// cloud.
#include "welkin/reference/cloud_path_tracer.h"

#include <gtest/gtest.h>

#include "flat_slab.h"
#include "media.h"
#include "welkin/clouds/layers_source.h"
#include "welkin/clouds/sphere_source.h"
#include "welkin/reference/radiance.h"

namespace welkin::reference {
namespace {

constexpr double R = 6'360'000;
constexpr double kSigmas = 4;  // as in path_tracer_test.cpp
const RootFrame kRoot = RootFrame::enclosing(R, 20'000);
const DetailRule kFine{.depth = 16};  // voxels of 28 m: over that a slab's faces are smooth, which changes no optical depth

Medium bare(Spectrum albedo) {
  Medium medium;
  medium.radius_m = R, medium.top_m = 6000;
  medium.albedo = albedo;
  return medium;
}

// Over the north pole, azimuth 0 towards the sun.
PathRay rayOf(double altitude_m, double sun_deg, double view_deg, double azimuth_deg) {
  const double s = std::sin(view_deg * kDeg), a = azimuth_deg * kDeg;
  return {{0, 0, R + altitude_m},
          {s * std::cos(a), s * std::sin(a), std::cos(view_deg * kDeg)},
          {std::sin(sun_deg * kDeg), 0, std::cos(sun_deg * kDeg)}};
}

std::unique_ptr<DensitySource> slabOf(double depth) { return LayeredClouds::slab({1000, 3000, depth / 2000}, kRoot); }

TEST(CloudPathTracer, FurnaceIsWhite) {
  const SphereCloud ball({{0, 0, R + 2000}, 800, 0.02}, kRoot);
  const auto slab = slabOf(20);
  const Medium white = bare(Spectrum(1));
  const Medium hazy =
      mediumOf(R, 50'000, {{"haze", ExponentialProfile{3000}, {1e-5, 5e-5, 2e-4}, {}, PhaseType::CornetteShanks, 0.7}}, {1, 1, 1});
  for (const Medium* air : {&white, &hazy})
    for (const DensitySource* source : {static_cast<const DensitySource*>(&ball), static_cast<const DensitySource*>(slab.get())}) {
      const CloudPathTracer tracer(*air, *source, kRoot, kFine);
      for (const auto& [h, view] : {std::pair{0.0, 0.0}, {2000.0, 80.0}, {5000.0, 150.0}}) {
        PathSettings settings;
        settings.light = Light::Everywhere, settings.maxPaths = 1;  // one round
        const Estimate e = tracer.estimate(rayOf(h, 0, view, 0), settings);
        for (int k = 0; k < 3; ++k) {
          // Nothing is absorbed: paths of one wavelength end with 1 each, and only the sharing between wavelengths spreads them.
          EXPECT_NEAR(e.mean[k], 1, kSigmas * e.standardError[k] + 1e-9) << h << " " << view << " " << k;
          EXPECT_LT(e.standardError[k], 0.03);
        }
      }
      EXPECT_EQ(tracer.aboveBounds(), 0u);
    }
}

// Sunlight on white ground, seen from below and through a slab: exp(-tau / mu) each way.
TEST(CloudPathTracer, BeerAndLambert) {
  for (const double depth : {0.3, 2.0}) {
    const auto slab = slabOf(depth);
    const Medium white = bare(Spectrum(1));
    const CloudPathTracer tracer(white, *slab, kRoot, kFine);
    for (const double sun : {20.0, 60.0}) {
      PathSettings settings;
      settings.maxOrders = 1, settings.relativeError = 0.01, settings.maxPaths = 100'000;
      const double mu0 = std::cos(sun * kDeg);
      const Estimate below = tracer.estimate(rayOf(500, sun, 130, 90), settings);
      const double ground = mu0 / kPi * std::exp(-depth / mu0);
      EXPECT_NEAR(below.mean.y / ground, 1, kSigmas * below.standardError.y / ground + 2e-3)
          << depth << " " << sun;  // curvature: 2 km over R
      EXPECT_LT(below.standardError.y, 0.03 * ground);
    }
  }
}

// One scattering of a slab over black ground: reflected phase mu0 / (mu + mu0) (1 - exp(-tau (1/mu + 1/mu0))), transmitted likewise.
TEST(CloudPathTracer, OneOrderOfASlab) {
  for (const double depth : {0.01, 1.0, 10.0}) {
    const auto slab = slabOf(depth);
    const Medium black = bare(Spectrum(0));
    const CloudPathTracer tracer(black, *slab, kRoot, kFine);
    PathSettings settings;
    settings.maxOrders = 1, settings.relativeError = 0.02, settings.maxPaths = 60'000;
    const double mu0 = std::cos(50 * kDeg), mu = std::cos(30 * kDeg);
    const PathRay ray = rayOf(5000, 50, 150, 60);
    const double expected =
        phase(Droplets{}, glm::dot(ray.direction, ray.towardsSun)) * mu0 / (mu + mu0) * -std::expm1(-depth * (1 / mu + 1 / mu0));
    const Estimate up = tracer.estimate(ray, settings);
    EXPECT_NEAR(up.mean.y / expected, 1, kSigmas * up.standardError.y / expected + 2e-3) << depth;
    const PathRay from = rayOf(100, 50, 30, 60);
    const double through =
        phase(Droplets{}, glm::dot(from.direction, from.towardsSun)) * mu0 / (mu0 - mu) * (std::exp(-depth / mu0) - std::exp(-depth / mu));
    if (depth > 5) continue;  // e^-11 of the light: too few paths meet it
    const Estimate down = tracer.estimate(from, settings);
    EXPECT_NEAR(down.mean.y / through, 1, kSigmas * down.standardError.y / through + 2e-3) << depth;
  }
}

// Isotropic droplets, all orders: the integral equation of a flat slab.
TEST(CloudPathTracer, AllOrdersOfASlab) {
  for (const auto& [depth, ground] : {std::pair{1.0, 0.0}, {8.0, 0.0}, {4.0, 0.5}}) {
    const auto slab = slabOf(depth);
    const Medium medium = bare(Spectrum(ground));
    const CloudPathTracer tracer(medium, *slab, kRoot, kFine, {.forwardG = 0, .backwardG = 0, .forwardShare = 1});
    PathSettings settings;
    settings.relativeError = 0.015, settings.maxPaths = 30'000;
    const FlatSlab flat(depth, 1, ground, std::cos(40 * kDeg));
    const Estimate up = tracer.estimate(rayOf(5000, 40, 120, 70), settings), down = tracer.estimate(rayOf(0, 40, 35, 70), settings);
    const double top = flat.up(std::cos(60 * kDeg)), bottom = flat.down(std::cos(35 * kDeg));
    // 300 cells err by 3e-4 a depth of 4; at 60 degrees the curvature turns mu by 2e-3 within the slab
    EXPECT_NEAR(up.mean.y / top, 1, kSigmas * up.standardError.y / top + 3e-3) << depth;
    EXPECT_NEAR(down.mean.y / bottom, 1, kSigmas * down.standardError.y / bottom + 3e-3) << depth;
    EXPECT_LT(up.standardError.y, 0.02 * top);
  }
}

// Where there is as good as no cloud it is the clear sky, by wavelength, in twilight too.
TEST(CloudPathTracer, ClearAirIsTheClearSky) {
  const auto nothing = slabOf(1e-9);
  const Medium air = earth(0.004675);
  const CloudPathTracer tracer(air, *nothing, kRoot, kFine);
  const PathTracer clear(air);
  for (const auto& [h, sun, view, azimuth] :
       {std::array{0.0, 50.0, 60.0, 30.0}, std::array{9000.0, 88.0, 88.0, 20.0}, std::array{400'000.0, 60.0, 120.0, 90.0}}) {
    PathSettings settings;
    settings.relativeError = 0.01, settings.maxPaths = 60'000;
    const ProbeResult sky = radiance(air, clear, probeRay(h, sun, view, azimuth), settings);
    settings.relativeError = 0.03;
    const Estimate e = tracer.estimate(rayOf(h, sun, view, azimuth), settings);
    for (int k = 0; k < 3; ++k) {
      const double truth = sky.radiance[std::size_t(k)], error = std::hypot(e.standardError[k], sky.standardError[std::size_t(k)]);
      EXPECT_NEAR(e.mean[k] / truth, 1, kSigmas * error / truth + 3e-4) << sun << " " << k;
      EXPECT_LT(e.standardError[k], 0.1 * truth) << sun << " " << k;
    }
  }
}

TEST(CloudPathTracer, RepeatsItselfForAnyThreads) {
  const auto slab = slabOf(5);
  const Medium medium = bare(Spectrum(0.3));
  const CloudPathTracer tracer(medium, *slab, kRoot, kFine);
  PathSettings settings;
  settings.maxPaths = 1;
  const Estimate one = tracer.estimate(rayOf(5000, 30, 140, 10), settings);
  settings.threads = 2;
  const Estimate two = tracer.estimate(rayOf(5000, 30, 140, 10), settings);
  EXPECT_EQ(one.mean, two.mean);
  settings.seed = 2;
  const Estimate other = tracer.estimate(rayOf(5000, 30, 140, 10), settings);
  EXPECT_NE(one.mean, other.mean);
  EXPECT_NEAR(one.mean.y, other.mean.y, kSigmas * std::hypot(one.standardError.y, other.standardError.y));
}

}  // namespace
}  // namespace welkin::reference
