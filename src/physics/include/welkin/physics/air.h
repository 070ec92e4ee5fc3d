#pragma once
// The scene's air as shaders and their C++ twins read it.
#include "welkin/core/result.h"
#include "welkin/physics/scene.h"
#include "welkin/shared/air.glsl.h"

namespace welkin {

// Whether the layer's phase function is too sharp for directions spread over the sphere: Henyey-Greenstein or Cornette-Shanks, |g| > 0.3.
bool isPeaked(const shared::AirLayer& layer);

// The Earth's clear air as published comparisons of skies use it: Rayleigh, Mie and ozone (Hillaire 2020, table 1), shell of 100 km.
Atmosphere earthAir();

// Scale height, half width of a tent, or height of a uniform layer.
double layerThickness_m(const AirLayer& layer);

// Height of the shell that is drawn, m: the atmosphere's top_m, or where above it nothing is left to see: the longest path through the
// rest has an optical depth below 1e-8.
double airTop_m(const Scene& scene);

// Lengths in metres, coefficients in 1/m at 680, 550, 440 nm. No sun: its irradiance is 0. The view frame is left zero. Fails in one line
// without an atmosphere, with more than six layers, or with values out of range. The layer with the sharpest phase function
// (Henyey-Greenstein or Cornette-Shanks with |g| > 0.3; of several the one that scatters most) becomes `peakLayer`.
// `degree`: of the harmonics that will hold the diffuse light (sky_model.h); what a phase function has beyond them counts as straight on
// (`forward`); 0: nothing does, extinction is physical.
Result<shared::AirBlock> airBlock(const Scene& scene, int degree = 0);

// View frame for a camera at this distance from the centre and altitude above the ground (doubles: their difference is exact),
// camera's radial direction and direction towards the sun, both unit, planet frame.
shared::AirViewFrame airViewFrame(const shared::AirParams& air, double centre_m, double altitude_m, glm::dvec3 up, glm::dvec3 toSun);

}  // namespace welkin
