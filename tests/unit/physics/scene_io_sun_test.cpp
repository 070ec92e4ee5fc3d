// Times and places of the sun that are published, not computed by the same formula.
#include <gtest/gtest.h>

#include "welkin/physics/sun_position.h"

namespace welkin {
namespace {

SubsolarPoint at(const char* utc) {
  const auto days = daysSinceJ2000(utc);
  EXPECT_TRUE(days.ok()) << utc;
  return subsolarPoint(days.ok() ? *days : 0);
}

TEST(SunPosition, daysCount) {
  EXPECT_EQ(*daysSinceJ2000("2000-01-01T12:00:00Z"), 0);
  EXPECT_EQ(*daysSinceJ2000("2000-01-02T12:00Z"), 1);
  EXPECT_EQ(*daysSinceJ2000("2100-03-01T00:00:00Z"), 36583.5);  // 2000 is a leap year, 2100 is not: 36,525 + 59 - 0.5
  EXPECT_NEAR(*daysSinceJ2000("2000-01-01T12:00:30.5Z"), 30.5 / 86400, 1e-12);
}

TEST(SunPosition, wrongTimes) {
  for (const char* text :
       {"", "Z", "2000-01-01", "2000-13-01T00:00:00Z", "2023-02-29T00:00:00Z", "2000-01-01T24:00:00Z", "2000-01-01T00:60:00Z",
        "2000-01-01T00:00:61Z", "2000-01-01T00:00:nanZ", "2000-01-01T00:00:00", "2000-01-01T00:00:00+01Z", "20000-01-01T00:00:00Z"}) {
    EXPECT_FALSE(daysSinceJ2000(text).ok()) << text;
  }
}

// Equinoxes and solstices of 2024 (US Naval Observatory, to the minute: 0.0003 degrees of declination an equinox minute).
TEST(SunPosition, seasons) {
  EXPECT_NEAR(at("2024-03-20T03:06:00Z").latitude_deg, 0, 0.01);
  EXPECT_NEAR(at("2024-09-22T12:44:00Z").latitude_deg, 0, 0.01);
  EXPECT_NEAR(at("2024-06-20T20:51:00Z").latitude_deg, 23.436, 0.01);
  EXPECT_NEAR(at("2024-12-21T09:20:00Z").latitude_deg, -23.436, 0.01);
}

// Equation of time at 12:00 UTC: the sun is 16 min 26 s ahead on 3 November and 14 min 14 s behind on 11 February (yearly tables;
// they differ by a few seconds from year to year: 0.03 degrees).
TEST(SunPosition, equationOfTime) {
  EXPECT_NEAR(at("2023-11-03T12:00:00Z").longitude_deg, -(16 + 26.0 / 60) / 4, 0.03);
  EXPECT_NEAR(at("2023-02-11T12:00:00Z").longitude_deg, (14 + 14.0 / 60) / 4, 0.03);
  EXPECT_NEAR(at("2023-11-03T00:00:00Z").longitude_deg, 180 - (16 + 26.0 / 60) / 4, 0.03);
}

}  // namespace
}  // namespace welkin
