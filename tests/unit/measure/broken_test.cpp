// A wrong answer must be able to fail: each check of the suite that guards integrators, phase functions and extinction passes on what the
// program uses and fails on a copy that is broken on purpose.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "welkin/measure/stress.h"
#include "welkin/shared/cloud_light.glsl.h"
#include "welkin/shared/phase.glsl.h"

namespace welkin::measure {
namespace {
using shared::SegmentGains, shared::uint, shared::vec4;

// ---- the checks

bool ordersHold(GainsRule gains) {
  for (const OrderCheck& c : checkOrders(gains))
    if (!c.ok) return false;
  return true;
}

bool matrixHolds(GainsRule gains) {
  StressReport report;
  report.defaultIntegrator = kIntegratorNames[std::size_t(Integrator::ExponentialLinear)];
  report.cells = stressLines({.quick = true, .rays = 1}, gains);
  return report.ok();
}

// Energy: of an even medium with a source of 1 an opaque line shows 1, by every rule whose steps resolve it, and a thin one its opacity.
bool furnaceHolds(GainsRule gains) {
  for (std::size_t rule = 0; rule < kIntegratorNames.size(); ++rule) {
    for (const double depth : {0.01, 1.0, 12.0}) {
      const Line line{1, [=](double) { return depth; }, [](double) { return 1.0; }, [=](double s) { return depth * s; }, {}};
      const LineLight exact = exactLine(line), marched = marchLine(line, Integrator(rule), 1024, gains);
      // the rectangle's excess is half a step's depth: 0.006
      if (relativeError(marched, exact) > 0.01 || std::abs(marched.transmittance - exact.transmittance) > 1e-3) return false;
    }
  }
  return true;
}

// In an even medium with an even source the exponential rules are exact to rounding, from thin to thick steps.
bool exponentialsAreExact(GainsRule gains) {
  for (std::size_t rule = std::size_t(Integrator::ExponentialConstant); rule < kIntegratorNames.size(); ++rule) {
    for (double x = 1e-6; x < 2e6; x *= 10) {
      const Line line{1, [=](double) { return 16 * x; }, [](double) { return 1.0; }, [=](double s) { return 16 * x * s; }, {}};
      if (relativeError(marchLine(line, Integrator(rule), 16, gains), exactLine(line)) > 1e-5) return false;
    }
  }
  return true;
}

// A wall behind clear air, its source linear from the eye: seen is the wall's front, half way between the two midpoints.
bool linearSourceIsFollowed(GainsRule gains) {
  const Line line{1, [](double s) { return s < 0.5 ? 1e-9 : 1e6; }, [](double s) { return 1 - 0.8 * s; }, {}, {0.5}};
  return std::abs(marchLine(line, Integrator::ExponentialLinear, 2, gains).radiance - 0.6) < 1e-5;
}

// Integral over the sphere, by the midpoint rule in the angle, squeezed towards the forward and backward peaks; 1e-4 of its error is left.
using Phase = std::function<float(float)>;
bool phaseIsNormalised(const Phase& phase) {
  constexpr int kAngles = 20000;
  double sum = 0;
  for (int i = 0; i < kAngles; ++i) {
    const double u = (i + 0.5) / kAngles, angle = M_PI * u * u * (3 - 2 * u), weight = M_PI * 6 * u * (1 - u) / kAngles;
    sum += 2 * M_PI * std::sin(angle) * phase(float(std::cos(angle))) * weight;
  }
  return std::abs(sum - 1) < 1e-3;
}

// Opacity of a ball of cloud along lines at several distances from its centre, against 1 - exp(-sigma chord).
using Extinction = std::function<double(double)>;  // of the true one
bool extinctionIsRight(const Extinction& drawn) {
  for (const double sigma : {0.1, 1.0, 5.0}) {
    for (const double off : {0.0, 0.5, 0.9}) {
      const double chord = 2 * std::sqrt(1 - off * off);
      const Line line{chord, [&](double) { return drawn(sigma); }, [](double) { return 1.0; }, {}, {}};
      if (std::abs(marchLine(line, Integrator::ExponentialLinear, 16).radiance + std::expm1(-sigma * chord)) > 1e-4) return false;
    }
  }
  return true;
}

// ---- integrators, each broken in one place

SegmentGains wrongSimpsonWeight(uint rule, vec4 x, float l) {  // 1/6, 3/6, 1/6
  SegmentGains g = shared::segmentGains(rule, x, l);
  if (rule == shared::kSimpson) g.gain.y *= 0.75f;
  return g;
}
SegmentGains slightlyWrongSimpsonWeights(uint rule, vec4 x, float l) {  // of the right sum: only the order suffers
  SegmentGains g = shared::segmentGains(rule, x, l);
  if (rule == shared::kSimpson) g.gain.x *= 1.2f, g.gain.y *= 0.9f, g.gain.z *= 1.2f;
  return g;
}
SegmentGains rectangleAtBothEnds(uint rule, vec4 x, float l) {  // the trapezoid forgets that its end lies behind the segment
  SegmentGains g = shared::segmentGains(rule, x, l);
  if (rule == shared::kTrapezoid) g.gain.y = 0.5f * x.y * l;
  return g;
}
SegmentGains forgottenTransmittance(uint rule, vec4 x, float l) {  // cloud behind cloud is as bright
  SegmentGains g = shared::segmentGains(rule, x, l);
  g.transmittance = 1;
  return g;
}
SegmentGains explicitInDisguise(uint rule, vec4 x, float l) {  // the exponential rule's gain without saturation
  SegmentGains g = shared::segmentGains(rule, x, l);
  if (rule == shared::kExponentialLinear) g.gain = vec4(x.x * l, 0, 0, 0);
  return g;
}
SegmentGains cancellingOpacity(uint rule, vec4 x, float l) {  // 1 - exp(-x) as it is written: thin segments lose their digits
  SegmentGains g = shared::segmentGains(rule, x, l);
  if (rule == shared::kExponentialLinear) g.gain = vec4(1 - std::exp(-x.x * l), 0, 0, 0);
  return g;
}
SegmentGains signOfTheSlope(uint rule, vec4 x, float l) {  // thick segments take their source from the back
  SegmentGains g = shared::segmentGains(rule, x, l);
  if (rule == shared::kExponentialLinear) g.gain = vec4(g.gain.x + 2 * g.gain.y, -g.gain.y, 0, 0);
  return g;
}
SegmentGains halvedExtinction(uint rule, vec4 x, float l) { return shared::segmentGains(rule, x * 0.5f, l); }

TEST(Broken, whatIsRightPasses) {
  EXPECT_TRUE(ordersHold(shared::segmentGains));
  EXPECT_TRUE(matrixHolds(shared::segmentGains));
  EXPECT_TRUE(furnaceHolds(shared::segmentGains));
  EXPECT_TRUE(exponentialsAreExact(shared::segmentGains));
  EXPECT_TRUE(linearSourceIsFollowed(shared::segmentGains));
}

TEST(Broken, integratorsAreCaught) {
  EXPECT_FALSE(ordersHold(wrongSimpsonWeight));
  EXPECT_FALSE(ordersHold(slightlyWrongSimpsonWeights));
  EXPECT_FALSE(ordersHold(rectangleAtBothEnds));
  EXPECT_FALSE(ordersHold(forgottenTransmittance));
  EXPECT_FALSE(ordersHold(halvedExtinction));
  EXPECT_FALSE(furnaceHolds(wrongSimpsonWeight));
  EXPECT_FALSE(furnaceHolds(forgottenTransmittance));
  EXPECT_FALSE(furnaceHolds(halvedExtinction));
  EXPECT_FALSE(matrixHolds(forgottenTransmittance));
  EXPECT_FALSE(matrixHolds(explicitInDisguise));
  EXPECT_FALSE(exponentialsAreExact(cancellingOpacity));
  EXPECT_FALSE(exponentialsAreExact(explicitInDisguise));
  EXPECT_FALSE(matrixHolds(halvedExtinction));
  EXPECT_FALSE(linearSourceIsFollowed(signOfTheSlope));
}

TEST(Broken, phaseFunctionsAreCaught) {
  std::vector<std::pair<const char*, Phase>> phases{{"Rayleigh", [](float c) { return shared::phaseRayleigh(c); }}};
  for (const float g : {-0.5f, 0.0f, 0.3f, 0.76f, 0.85f, 0.99f}) {
    phases.emplace_back("Henyey-Greenstein", [=](float c) { return shared::phaseHenyeyGreenstein(c, g); });
    phases.emplace_back("Cornette-Shanks", [=](float c) { return shared::phaseCornetteShanks(c, g); });
  }
  for (const float sharpness : {1.0f, shared::kBroadened}) phases.emplace_back("cloud", [=](float c) { return shared::cloudPhase(c, sharpness); });
  for (uint type = 0; type < 4; ++type) phases.emplace_back("by type", [=](float c) { return shared::phaseValue(type, 0.7f, c); });
  for (const auto& [name, phase] : phases) {
    EXPECT_TRUE(phaseIsNormalised(phase)) << name;
    EXPECT_FALSE(phaseIsNormalised([&](float c) { return phase(c) * 1.01f; })) << name << ", 1 % too bright";
    EXPECT_FALSE(phaseIsNormalised([&](float c) { return phase(c) * 0.0795775f; })) << name << ", divided by 4 pi twice";
  }
  // Cornette and Shanks with Henyey and Greenstein's factor
  EXPECT_FALSE(phaseIsNormalised([](float c) { return shared::phaseHenyeyGreenstein(c, 0.8f) * (1 + c * c); }));
}

TEST(Broken, extinctionIsCaught) {
  EXPECT_TRUE(extinctionIsRight([](double sigma) { return sigma; }));
  EXPECT_FALSE(extinctionIsRight([](double sigma) { return 0.5 * sigma; })) << "halved, as the thesis program's view extinction is";
  EXPECT_FALSE(extinctionIsRight([](double sigma) { return 1.01 * sigma; }));
}

}  // namespace
}  // namespace welkin::measure
