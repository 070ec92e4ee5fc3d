#include "welkin/physics/sun_position.h"

#include <charconv>
#include <chrono>
#include <cmath>
#include <numbers>

namespace welkin {
namespace {

constexpr double kRad = std::numbers::pi / 180;

double turn_deg(double angle_deg) { return angle_deg - 360 * std::floor(angle_deg / 360); }

// Exactly `width` digits at `at`.
bool digits(std::string_view text, std::size_t at, std::size_t width, int& value) {
  if (at + width > text.size()) return false;
  value = 0;
  for (std::size_t i = at; i < at + width; ++i) {
    if (text[i] < '0' || text[i] > '9') return false;
    value = value * 10 + (text[i] - '0');
  }
  return true;
}

}  // namespace

Result<double> daysSinceJ2000(std::string_view utc) {
  const Error wrong{"expected a time in UTC such as \"2024-06-21T12:00:00Z\", year 1600 to 2400"};
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;
  double second = 0;
  if (utc.size() < 17 || utc.back() != 'Z') return wrong;
  if (!digits(utc, 0, 4, year) || utc[4] != '-' || !digits(utc, 5, 2, month) || utc[7] != '-' || !digits(utc, 8, 2, day)) return wrong;
  if (utc[10] != 'T' || !digits(utc, 11, 2, hour) || utc[13] != ':' || !digits(utc, 14, 2, minute)) return wrong;
  if (utc.size() > 17) {
    int whole = 0;
    if (utc[16] != ':' || !digits(utc, 17, 2, whole)) return wrong;
    const char* end = utc.data() + utc.size() - 1;
    const auto parsed = std::from_chars(utc.data() + 17, end, second, std::chars_format::fixed);
    if (parsed.ec != std::errc() || parsed.ptr != end) return wrong;
  }
  using namespace std::chrono;
  const year_month_day date{std::chrono::year(year), std::chrono::month(unsigned(month)), std::chrono::day(unsigned(day))};
  // 61: a leap second is a legal time.
  if (year < 1600 || year > 2400 || !date.ok() || hour > 23 || minute > 59 || !(second < 61)) return wrong;
  const sys_days epoch = std::chrono::year(2000) / January / 1;
  return double((sys_days(date) - epoch).count()) + (hour - 12) / 24.0 + minute / 1440.0 + second / 86400.0;
}

SubsolarPoint subsolarPoint(double n) {
  const double L = turn_deg(280.460 + 0.9856474 * n);                                // mean longitude, aberration included, degrees
  const double g = turn_deg(357.528 + 0.9856003 * n) * kRad;                         // mean anomaly
  const double lambda = (L + 1.915 * std::sin(g) + 0.020 * std::sin(2 * g)) * kRad;  // ecliptic longitude
  const double epsilon = (23.439 - 0.0000004 * n) * kRad;                            // obliquity
  const double alpha_deg = std::atan2(std::cos(epsilon) * std::sin(lambda), std::cos(lambda)) / kRad;  // right ascension
  const double delta_deg = std::asin(std::sin(epsilon) * std::sin(lambda)) / kRad;                     // declination
  const double sidereal_deg = turn_deg(15 * (18.697374558 + 24.06570982441908 * n));
  return {delta_deg, turn_deg(alpha_deg - sidereal_deg + 180) - 180};
}

}  // namespace welkin
