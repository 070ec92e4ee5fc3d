#pragma once
// Where the sun stands over the Earth at a time.
#include <glm/glm.hpp>
#include <string_view>

#include "welkin/core/result.h"

namespace welkin {

struct SubsolarPoint {
  double latitude_deg = 0, longitude_deg = 0;  // longitude -180..180, east positive
};

// Days from 2000-01-01 12:00 UTC to "YYYY-MM-DDThh:mm[:ss[.fff]]Z" (1600..2400). Error: what was expected, without the place.
Result<double> daysSinceJ2000(std::string_view utc);

// Low-precision formulas for the Sun of the Astronomical Almanac (page C5), 0.01 degree from 1950 to 2050, with mean sidereal time
// of the US Naval Observatory ("Approximate Sidereal Time", 0.1 s a century).
SubsolarPoint subsolarPoint(double daysSinceJ2000);

}  // namespace welkin
