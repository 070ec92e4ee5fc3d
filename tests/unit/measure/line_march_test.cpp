// Lines marched with the renderer's code against their truth: orders of convergence, tolerance, ends.
#include "welkin/measure/line_march.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "welkin/reference/quadrature.h"

namespace welkin::measure {
namespace {

std::string nameOf(Integrator rule) { return kIntegratorNames[std::size_t(rule)]; }

Line even(double depth, double slope = 0) {
  return {1, [=](double) { return depth; }, [=](double s) { return 1 - slope * s; }, [=](double s) { return depth * s; }, {}};
}

// L of an even medium with S = 1 - a s over a unit line: (1 - e^-x) - a ((1 - e^-x) / x - e^-x).
TEST(LineMarch, truthMeetsClosedForms) {
  for (double x = 1e-8; x < 2e8; x *= 10) {
    for (const double a : {0.0, 0.5}) {
      const double o = -std::expm1(-x), mean = x < 1e-3 ? x / 2 - x * x / 3 : o / x - std::exp(-x);
      const LineLight exact = exactLine(even(x, a));
      EXPECT_NEAR(exact.radiance, o - a * mean, 1e-9 * o) << x;
      EXPECT_NEAR(exact.transmittance, std::exp(-x), 1e-14);
    }
  }
  // without its closed form the depth is made by quadrature
  for (const OrderLines& lines : orderLines()) {
    Line line = lines.family.front();
    const LineLight exact = exactLine(line);
    line.depth = nullptr;
    if (exact.transmittance > 1e-4) {
      EXPECT_NEAR(exactLine(line).radiance, exact.radiance, 1e-9) << lines.name;
    }
  }
}

TEST(LineMarch, ordersAreAsPromised) {
  for (const OrderCheck& c : checkOrders()) {
    std::printf("%-22s %-22s promised %.0f observed %.2f (%d steps)\n", c.line, nameOf(c.rule).c_str(), c.promised, c.observed.slope,
                c.observed.counts);
    EXPECT_TRUE(c.ok) << c.line << ", " << nameOf(c.rule) << ": " << c.observed.slope << ", promised " << c.promised;
    // no rule is better than it should be either: such a measurement would be wrong
    if (c.rule < Integrator::ExponentialConstant) {
      EXPECT_LE(c.observed.slope, c.promised + 0.5) << c.line << ", " << nameOf(c.rule);
    }
  }
}

// The explicit rules leave the furnace's bound where a step is thick, and the exponential ones never do.
TEST(LineMarch, onlyExplicitRulesExplode) {
  for (std::size_t i = 0; i < kIntegratorNames.size(); ++i) {
    const auto rule = Integrator(i);
    const LineLight light = marchLine(even(64e3), rule, 64);
    if (rule >= Integrator::ExponentialConstant) {
      EXPECT_NEAR(light.radiance, 1, 1e-6) << nameOf(rule);
    } else {
      EXPECT_GT(light.radiance, 100) << nameOf(rule);
    }
  }
}

// What the embedded estimate allows is kept: at most the tolerance, from thin to thick, with an edge too. Times 2: the estimate is of the
// coarse rule, and the first neglected terms may add up.
TEST(LineMarch, adaptiveKeepsItsTolerance) {
  std::vector<std::pair<std::string, Line>> lines;
  for (const OrderLines& l : orderLines())
    for (const Line& line : l.family) lines.emplace_back(l.name, line);
  for (const double x : {1.0, 1e3, 1e6})
    lines.emplace_back("edge", Line{1,
                                    [=](double s) { return s < 0.37 ? x * 1e-6 : x; },
                                    [](double s) { return 1 - 0.5 * s; },
                                    [=](double s) { return x * (1e-6 * std::min(s, 0.37) + std::max(s - 0.37, 0.0)); },
                                    {0.37}});
  for (const auto& [name, line] : lines) {
    const LineLight exact = exactLine(line);
    int segments = 0;
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5}) {
      const LineLight marched = marchLineAdaptive(line, tolerance);
      EXPECT_LE(std::abs(marched.radiance - exact.radiance), 2 * tolerance + 2e-6) << name << " at " << tolerance;  // 500 roundings at most
      segments = std::max(segments, marched.segments);
      EXPECT_LE(segments, 20 + 4 / std::sqrt(tolerance)) << name << " at " << tolerance << ": of second order, so with its root";
    }
  }
}

// The last step ends at the occluder: light from behind the line's end is not in it, and nothing in front is lost.
TEST(LineMarch, lastStepEndsAtTheOccluder) {
  for (const double length : {0.37, 1.0, 1234.567}) {
    bool beyond = false;
    double farthest = 0;
    Line line{length,
              [&](double s) {
                beyond |= s > length, farthest = std::max(farthest, s);
                return 1 / length;
              },
              [](double) { return 1.0; },
              {},
              {}};
    marchLine(line, Integrator::Trapezoid, 7);
    EXPECT_FALSE(beyond);
    EXPECT_EQ(farthest, length);
    farthest = 0;
    const LineLight adaptive = marchLineAdaptive(line, 1e-3);
    EXPECT_FALSE(beyond);
    EXPECT_EQ(farthest, length);
    EXPECT_NEAR(adaptive.transmittance, std::exp(-1), 1e-4);
  }
}

}  // namespace
}  // namespace welkin::measure
