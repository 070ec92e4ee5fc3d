// The tone curves against what their authors publish, and what every tone curve has to be.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "welkin/shared/tonemap.glsl.h"

namespace welkin::shared {
namespace {

struct Curve {
  std::string name;
  vec3 (*value)(vec3);
  float white;  // exposed grey that is shown as white (0.998 or more: within half a step of 8 bits)
  float slope;  // of display over exposed grey at 0.18, from the published formula differentiated by hand or in double
};
std::ostream& operator<<(std::ostream& out, const Curve& c) { return out << c.name; }

// Of a grey, which Hill's two matrices leave as it is.
double acesInDouble(double x) { return (x * (x + 0.0245786) - 0.000090537) / (x * (0.983729 * x + 0.4329510) + 0.238081); }

double lottesInDouble(double x) {
  const double a = 1.6, d = 0.977, most = 8, in = 0.18, shown = 0.267;
  const double spread = (std::pow(most, a * d) - std::pow(in, a * d)) * shown;
  const double b = (-std::pow(in, a) + std::pow(most, a) * shown) / spread;
  const double c = (std::pow(most, a * d) * std::pow(in, a) - std::pow(most, a) * std::pow(in, a * d) * shown) / spread;
  return std::pow(x, a) / (std::pow(x, a * d) * b + c);
}

// As the talk writes it, with three weights, for its default parameters.
double uchimuraInDouble(double x) {
  const double P = 1, a = 1, m = 0.22, l = 0.4, c = 1.33, b = 0;
  const double l0 = (P - m) * l / a, S0 = m + l0, S1 = m + a * l0, C2 = a * P / (P - S1);
  const double t = std::min(std::max(x / m, 0.0), 1.0);
  const double w0 = 1 - t * t * (3 - 2 * t), w2 = x < m + l0 ? 0 : 1, w1 = 1 - w0 - w2;
  return (m * std::pow(x / m, c) + b) * w0 + (m + a * (x - m)) * w1 + (P - (P - S1) * std::exp(-C2 * (x - S0) / P)) * w2;
}

double slopeOf(double (*f)(double), double x) { return (f(x + 1e-6) - f(x - 1e-6)) / 2e-6; }

const Curve kCurves[] = {
    {"aces", acesFilmic, 24.0f, float(slopeOf(acesInDouble, 0.18))},
    // (1 + x / w2) x / (1 + x): (1 + 2 x / w2 + x^2 / w2) / (1 + x)^2 at 0.18, w2 = 16
    {"reinhard", reinhardExtended, kReinhardWhite, float((1 + 2 * 0.18 / 16 + 0.18 * 0.18 / 16) / (1.18 * 1.18))},
    {"lottes", lottes, kLottesWhite, float(slopeOf(lottesInDouble, 0.18))},
    {"uchimura", uchimura, 0.532f + 0.468f * 6.5f, float(slopeOf(uchimuraInDouble, 0.18))},  // exp(-6.5) of 0.468 is left
};

class ToneCurves : public ::testing::TestWithParam<Curve> {
 protected:
  float grey(float x) const { return GetParam().value(vec3(x)).y; }
};
INSTANTIATE_TEST_SUITE_P(All, ToneCurves, ::testing::ValuesIn(kCurves), [](const auto& curve) { return curve.param.name; });

TEST_P(ToneCurves, ShowsBlackAsBlackAndWhiteAsWhite) {
  // Hill's fit is -0.00038 at 0 before its clamp; the others are exact.
  EXPECT_EQ(grey(0), 0);
  EXPECT_GE(grey(GetParam().white), 0.998f);
  EXPECT_GE(grey(kToneGreatest), 0.998f) << "the brightest that toneInput() lets through";
}

TEST_P(ToneCurves, RisesEverywhereAndStaysInside) {
  float last = -1;
  for (int i = 0; i <= 4000; ++i) {
    const float x = std::exp2(float(i) * 0.01f - 20.0f);  // 1e-6 to 1e6
    const float y = grey(x);
    ASSERT_TRUE(y >= 0 && y <= 1) << x;
    // 6e-7: a few roundings of a quotient near 1. A curve that falls by less than that is flat.
    ASSERT_GE(y, last - 6e-7f) << x;
    last = y;
  }
}

TEST_P(ToneCurves, GreyStaysGrey) {
  for (const float x : {0.01f, 0.18f, 1.0f, 3.0f}) {
    const vec3 c = GetParam().value(vec3(x));
    // Hill's matrices have five digits: their rows sum to 1 within 1e-5, the inverse's entries up to 1.6.
    EXPECT_NEAR(c.x, c.y, 4e-5f);
    EXPECT_NEAR(c.z, c.y, 4e-5f);
  }
}

TEST_P(ToneCurves, ContrastAtMiddleGreyIsThePublishedOne) {
  // Difference quotient over 0.01: error step^2 / 24 times the third derivative (under 100 here), 4e-4, and roundings of 1e-7 / 0.01.
  EXPECT_NEAR((grey(0.185f) - grey(0.175f)) / 0.01f, GetParam().slope, 1e-3f);
}

TEST_P(ToneCurves, SurvivesAnyLight) {
  for (const vec3 light : {vec3(0), vec3(1e-40f), vec3(1e38f), vec3(1e38f, 0, 0), vec3(0, 3e-5f, 1e20f), vec3(-1, -1e-3f, 0)}) {
    const vec3 c = GetParam().value(toneInput(light, 1e9f));
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(c[i] >= 0 && c[i] <= 1) << light.x << " " << c[i];
  }
}

TEST(ToneAnchors, Aces) {
  // The fit by hand: 0.036733611 / 0.347885085 at 0.18 and 1.024488063 / 1.654761 at 1.
  EXPECT_NEAR(acesCurve(0.18f), 0.105591f, 1e-6f);
  EXPECT_NEAR(acesCurve(1.0f), 0.619115f, 1e-6f);
}

TEST(ToneAnchors, Reinhard) {
  // Equation 4: the white point is white, far below it the luminance passes, 1 goes a little over one half.
  EXPECT_FLOAT_EQ(reinhardExtended(vec3(kReinhardWhite)).y, 1.0f);
  EXPECT_FLOAT_EQ(reinhardExtended(vec3(1)).y, (1 + 1 / 16.0f) / 2);
  const vec3 c(0.4f, 0.1f, 0.2f), d = reinhardExtended(c);
  EXPECT_FLOAT_EQ(d.x / d.y, 4.0f) << "a colour keeps its ratios";
  EXPECT_FLOAT_EQ(d.z / d.y, 2.0f);
}

TEST(ToneAnchors, Lottes) {
  EXPECT_NEAR(lottesCurve(0.18f), 0.267f, 1e-6f) << "middle grey of the talk";
  EXPECT_NEAR(lottesCurve(8.0f), 1.0f, 1e-6f);
  for (double x = 0.001; x < 8; x *= 1.1) EXPECT_NEAR(lottesCurve(float(x)), lottesInDouble(x), 2e-6) << x;  // pow of a float: 2 ulp of 1
}

TEST(ToneAnchors, Uchimura) {
  EXPECT_FLOAT_EQ(uchimuraCurve(0.22f), 0.22f) << "the straight part passes light as it is";
  EXPECT_FLOAT_EQ(uchimuraCurve(0.5f), 0.5f);
  EXPECT_FLOAT_EQ(uchimuraCurve(0.532f), 0.532f) << "and ends in the shoulder's value";
  for (double x = 0.001; x < 8; x *= 1.1) EXPECT_NEAR(uchimuraCurve(float(x)), uchimuraInDouble(x), 1e-6) << x;
}

TEST(Display, DitherIsHalfAStepAndPlaceIsAllItDependsOn) {
  double sum = 0;
  for (uint y = 0; y < 64; ++y)
    for (uint x = 0; x < 64; ++x) {
      const vec3 v = displayValues(vec3(0.18f), x, y);
      ASSERT_NEAR(v.x, srgbEncode(0.18f), 0.5f / 255 + 1e-6f);
      ASSERT_EQ(v, displayValues(vec3(0.18f), x, y));
      sum += v.x;
    }
  // 4096 values uniform over a step: standard error 1 / (255 sqrt(12 * 4096)) = 1.8e-5; four of them.
  EXPECT_NEAR(sum / 4096, srgbEncode(0.18f), 7e-5);
}

}  // namespace
}  // namespace welkin::shared
