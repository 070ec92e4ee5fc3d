#pragma once
// What every way of computing the sky is asked, and answers: the radiance along one ray through the clear air. The reference and the
// renderer's methods meet here.
#include <limits>
#include <numbers>

#include "welkin/physics/scene.h"

namespace welkin {

// Angles are the observer's own; azimuth 0 looks towards the sun. An observer below the ground is taken to stand on it; one outside the
// shell sees it from there. Over a planet without maps, latitude and longitude change nothing.
struct ProbeRay {
  double altitude_m = 0;
  double sunZenith_rad = 0, viewZenith_rad = 0;                    // 0 to pi
  double azimuth_rad = 0;                                          // of the view relative to the sun's
  double maxDistance_m = std::numeric_limits<double>::infinity();  // from the observer; the ray ends there, with nothing behind it
  double latitude_rad = std::numbers::pi / 2, longitude_rad = 0;   // of the observer
};

// At 680, 550, 440 nm, for a solar irradiance of 1: radiance in 1/sr, with the ground's where the ray ends on it (the sun's own disc is
// not part of it). Transmittance is that of the air up to where the ray ends: ground, shell's top, or the greatest distance.
struct ProbeResult {
  Spectrum3 radiance{}, transmittance{1, 1, 1};
  Spectrum3 standardError{};  // of the radiance; 0 where nothing was drawn at random
};

}  // namespace welkin
