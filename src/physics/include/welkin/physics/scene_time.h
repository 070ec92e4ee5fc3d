#pragma once
// What a scene's time moves: the sun, by the planet's day, and the clouds, by their mean wind.
#include "welkin/physics/scene.h"

namespace welkin {

inline constexpr double kGreatestTime_s = 1e12;  // of a scene, either way

// Towards the sun at a time of the scene, unit, planet frame: about the axis, 2 pi a day, westwards. Its declination stays: over the Earth
// that is at most 0.4 degrees a day from the truth (the slope of the declination at an equinox, 23.4 degrees * 2 pi / 365).
glm::dvec3 sunAt(const Sun& sun, double time_s);
// The direction at time 0 of a sun that stands there at that time.
glm::dvec3 sunStartOf(const Sun& sun, glm::dvec3 toSun_planet, double time_s);

// The scene with its sun where it stands then.
Scene atTime(Scene scene, double time_s);

// How far the mean wind has turned the clouds eastwards about the axis since time 0, radians, 0 <= angle < 2 pi.
double windTurn_rad(const Scene& scene, double time_s);

// About +Z, counter-clockwise seen from the north (eastwards). An angle of 0 changes no bit.
glm::dvec3 turned(glm::dvec3 x_planet, double east_rad);
View turned(const View& view, double east_rad);

}  // namespace welkin
