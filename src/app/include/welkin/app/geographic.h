#pragma once
// A view in the words of a traveller: the way back from toView (physics/scene_io.h).
#include "welkin/physics/scene_io.h"

namespace welkin::app {

// Latitude, longitude (-180..180), altitude, heading (0..360), pitch and roll (-180..180). Over a pole longitude is 0; looking straight up
// or down the heading is that of the picture's top (or of its bottom) and the roll is 0. toView of it is the same view but for rounding.
GeographicView toGeographic(const View& view, double planetRadius_m);

// "47.36 N 8.54 E", and "400 km", "1.5 m": for status lines.
std::string placeText(const GeographicView& view);
std::string lengthText(double length_m);

}  // namespace welkin::app
