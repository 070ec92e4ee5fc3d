// Colours of the debug views.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "welkin/shared/debug.glsl.h"

namespace welkin::shared {
namespace {

double linear(double s) { return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4); }

// CIELAB of an sRGB colour, white D65: another space than the one that the scale was made in.
glm::dvec3 cielab(const vec3& c) {
  const double r = linear(double(c.x)), g = linear(double(c.y)), b = linear(double(c.z));
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double x = f((0.4124564 * r + 0.3575761 * g + 0.1804375 * b) / 0.95047), y = f(0.2126729 * r + 0.7151522 * g + 0.0721750 * b),
               z = f((0.0193339 * r + 0.1191920 * g + 0.9503041 * b) / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

TEST(DebugColours, ScaleRisesEvenly) {
  constexpr int kSteps = 64;
  const double whole = cielab(scaleColour(1)).x - cielab(scaleColour(0)).x;
  EXPECT_GT(whole, 70) << "most of the way from black to white: it survives a grey printer";
  for (int i = 0; i < kSteps; ++i) {
    const glm::dvec3 a = cielab(scaleColour(float(i) / kSteps)), b = cielab(scaleColour(float(i + 1) / kSteps));
    // CIELAB's lightness is not quite OKLab's: within a quarter of even.
    EXPECT_NEAR((b.x - a.x) * kSteps / whole, 1, 0.25) << i;
  }
  EXPECT_EQ(scaleColour(-1), scaleColour(0));
  EXPECT_EQ(scaleColour(7), scaleColour(1));
}

TEST(DebugColours, LevelsAndKindsAreToldApart) {
  // A CIELAB distance of 20 is seen at a glance; just noticeable is 2.3.
  for (uint i = 0; i <= 24; ++i) {
    EXPECT_GT(glm::length(cielab(levelColour(i)) - cielab(kDebugNoneColour)), 20);
    for (uint j = i + 1; j < std::min(i + 5, 25u); ++j)  // levels that border on each other in a picture
      EXPECT_GT(glm::length(cielab(levelColour(i)) - cielab(levelColour(j))), 20) << i << " " << j;
  }
  for (uint i = 0; i < kHistoryKinds; ++i) {
    EXPECT_GT(glm::length(cielab(historyColour(i)) - cielab(kDebugNoneColour)), 20);
    for (uint j = i + 1; j < kHistoryKinds; ++j)
      EXPECT_GT(glm::length(cielab(historyColour(i)) - cielab(historyColour(j))), 20) << i << " " << j;
  }
}

TEST(DebugColours, PlacesOnLogarithmicScales) {
  EXPECT_FLOAT_EQ(debugPlace(WK_DEBUG_STEPS, 16), 0.5f) << "1 to 256";
  EXPECT_EQ(debugPlace(WK_DEBUG_STEPS, 0), 0);
  EXPECT_FLOAT_EQ(debugPlace(WK_DEBUG_DENSITY, 1e-3f), 0.5f) << "1e-5 to 1e-1";
  EXPECT_EQ(debugPlace(WK_DEBUG_DENSITY, 0), 0);
  EXPECT_EQ(debugPlace(WK_DEBUG_LIGHT, 0.25f), 0.25f);
  EXPECT_EQ(historyKind(0, true), kHistoryTurn);
  EXPECT_EQ(historyKind(0, false), kHistoryRejected);
  EXPECT_EQ(historyKind(4, true), kHistoryYoung);
  EXPECT_EQ(historyKind(5, false), kHistoryMiddle);
  EXPECT_EQ(historyKind(255, false), kHistoryOld);
}

}  // namespace
}  // namespace welkin::shared
