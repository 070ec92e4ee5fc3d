#pragma once
// The sun by date, and as someone at a place sees it.
#include <string>

#include "welkin/physics/scene_io.h"
#include "welkin/physics/sun_position.h"

namespace welkin::app {

struct SunInSky {
  double elevation_deg = 0, azimuth_deg = 0;  // above the horizon of a sphere; clockwise from north, 0..360
};
// The sun is taken as infinitely far, and the air does not bend its rays. Over a pole north is as in toView.
SunInSky sunInSky(const glm::dvec3& direction_planet, double latitude_deg, double longitude_deg);
glm::dvec3 sunDirection(const SunInSky& sun, double latitude_deg, double longitude_deg);

// Towards the sun, planet frame, at a time; the way back of daysSinceJ2000, to the millisecond. Empty outside the years 1600 to 2400.
glm::dvec3 sunDirectionAt(double daysSinceJ2000);
std::string utcText(double daysSinceJ2000);

}  // namespace welkin::app
