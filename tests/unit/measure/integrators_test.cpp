// The integrators' closed forms, in single precision against double, for optical depths from 1e-8 to 1e8.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "welkin/shared/integrators.glsl.h"

namespace welkin {
namespace {
using namespace shared;

constexpr double kEps = 6e-8;  // half a unit in the last place of 1, rounded up

std::vector<float> depths() {
  std::vector<float> out;
  for (int i = 0; i <= 1600; ++i) out.push_back(float(std::pow(10.0, -8 + i / 100.0)));
  return out;
}

// The series below 1/4 has five roundings and a rest of 5e-8; above, exp2's argument is rounded: (1 + tau) kEps of e^-tau, which is at most
// 4 kEps of 1 - e^-tau at 1/4.
TEST(Integrators, opacityKeepsItsDigitsFromThinToThick) {
  for (const float tau : depths()) {
    const double right = -std::expm1(-double(tau));
    EXPECT_NEAR(opacityOf(tau), right, right * 8 * kEps) << tau;
    EXPECT_NEAR(transmittanceOf(tau), std::exp(-double(tau)), (2 + 2 * tau) * kEps * std::exp(-double(tau)) + 1e-38) << tau;
    EXPECT_LE(opacityOf(tau), 1) << tau;
  }
  EXPECT_EQ(opacityOf(0), 0);
  EXPECT_EQ(transmittanceOf(0), 1);
}

// 1/tau - 1/(e^tau - 1); below 1e-2 its series, for the difference cancels.
TEST(Integrators, emissionDepthIsNearItsClosedForm) {
  double worst = 0;
  for (const float tau : depths()) {
    const double t = tau, right = t < 1e-2 ? 0.5 - t / 12 : 1 / t - 1 / std::expm1(t);
    worst = std::max(worst, std::abs(emissionDepth(tau) - right));
    EXPECT_GT(emissionDepth(tau), 0);
    EXPECT_LE(emissionDepth(tau), 0.5f);
  }
  EXPECT_LE(worst, 0.011) << "what the header says";
  EXPECT_GT(worst, 0.009) << "what the header says";
}

// Sum of the gains over the opacity in an even medium: rectangle x / (1 - e^-x), trapezoid x/2 coth(x/2), Simpson's rules likewise.
TEST(Integrators, excessOfEveryRuleInAnEvenMedium) {
  for (const float tau : depths()) {
    const double x = tau, o = -std::expm1(-x), h = std::exp(-x / 2), t = std::exp(-x / 3);
    const double right[] = {
        x / o, x / 2 * (1 + h * h) / o, x / 6 * (1 + 4 * h + h * h) / o, x / 8 * (1 + 3 * t + 3 * t * t + t * t * t) / o, 1, 1, 1};
    // a dozen roundings, and exp2's argument: its error falls with it, at most 0.4 kEps of 1
    for (uint rule = 0; rule < kIntegrators; ++rule)
      EXPECT_NEAR(gainExcess(rule, tau), right[rule], right[rule] * 20 * kEps) << rule << " at " << tau;
  }
}

// Between any extinctions: transmittance and, of the exponential rules, opacity add up to 1, and no gain is negative or not finite.
TEST(Integrators, exponentialRulesConserveEnergyAndNothingIsNegative) {
  const float values[] = {0, 1e-8f, 1e-3f, 0.2f, 0.3f, 1, 10, 1e3f, 1e8f};
  for (const float a : values)
    for (const float b : values)
      for (const float c : values)
        for (const float d : values)
          for (uint rule = 0; rule < kIntegrators; ++rule) {
            const SegmentGains g = segmentGains(rule, {a, b, c, d}, 1);
            for (int i = 0; i < 4; ++i)
              ASSERT_TRUE(g.gain[i] >= 0 && g.coarse[i] >= 0 && std::isfinite(g.gain[i]) && std::isfinite(g.coarse[i]));
            ASSERT_TRUE(g.transmittance >= 0 && g.transmittance <= 1);
            if (rule < kExponentialConstant) continue;
            const float sum = g.gain.x + g.gain.y + g.gain.z + g.gain.w;
            ASSERT_NEAR(sum + g.transmittance, 1, 16 * kEps) << rule << ": " << a << " " << b << " " << c << " " << d;
          }
}

// A source that is linear over two segments of even medium: what the second sends is exact but for the quotient of emissionDepth.
TEST(Integrators, linearRuleFollowsALinearSource) {
  for (const float tau : depths()) {
    const SegmentGains g = segmentGains(kExponentialLinear, vec4(tau), 1);
    const double before = 0.2, here = 0.6, slope = here - before;  // at midpoints, one length apart
    const double t = tau, right = -std::expm1(-t) * (here + slope * ((t < 1e-2 ? 0.5 - t / 12 : 1 / t - 1 / std::expm1(t)) - 0.5));
    EXPECT_NEAR(double(g.gain.x) * here + double(g.gain.y) * before, right, right * 1e-6 + 0.011 * slope * -std::expm1(-t)) << tau;
  }
}

}  // namespace
}  // namespace welkin
