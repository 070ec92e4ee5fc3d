#pragma once
// Rays cut into cells by altitude, with the optical depth of each: what the path tracer draws its events from.
#include <vector>

#include "welkin/reference/shell_ray.h"

namespace welkin::reference {

// Altitudes that cut the shell so finely that three Gauss points integrate a cell's extinction: the medium's levels, and between them
// steps of a scale height as far up as a layer's horizontal optical depth is above 1e-6.
// Error of a cell's optical depth, relative: 5e-7 where the ray climbs, 8e-5 about its lowest point.
std::vector<double> cellAltitudes(const Medium& medium);

struct Cells {
  std::vector<double> edge_m;        // distances, n + 1
  std::vector<Spectrum> depth;       // optical depth from the first edge to each, n + 1
  std::vector<Spectrum> scattering;  // the part of each cell's optical depth that is scattering, n

  std::size_t count() const { return scattering.size(); }
};

// Cells of [0, length] of a ray. `out` keeps its memory from call to call.
void cutRay(const Medium& medium, const std::vector<double>& altitudes_m, const ShellRay& ray, double length_m, Cells& out);

// Optical depth of [from, to] within one cell, by the same rule.
Spectrum depthWithin(const Medium& medium, const ShellRay& ray, double from_m, double to_m);

// Transmittance from an altitude to the top along a zenith cosine by the same rule, 0 where the ground is in the way.
Spectrum quickTransmittance(const Medium& medium, const std::vector<double>& altitudes_m, double altitude_m, double mu,
                            std::vector<double>& scratch);

}  // namespace welkin::reference
