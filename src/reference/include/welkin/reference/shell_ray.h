#pragma once
// A straight ray through the shell in forms in which nothing cancels, and where rays meet the ground, the top and other altitudes.
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "welkin/physics/probe.h"
#include "welkin/reference/medium.h"

namespace welkin::reference {

// A ray that starts inside the shell. Distances t along it in metres from its start.
struct ShellRay {
  double radius_m;    // of the ground
  double altitude_m;  // of the start, at least 0
  double mu;          // zenith cosine at the start
  double impact_m;    // least distance of the whole line from the centre: r sin(zenith angle)

  double startRadius_m() const { return radius_m + altitude_m; }
  double radiusAt(double t) const;
  // (h0 (2R + h0) + t (2 r0 mu + t)) / (r(t) + R), at least 0: rounding may leave the ground by 1e-9 m.
  double altitudeAt(double t) const;
  double tangentDistance_m() const { return -startRadius_m() * mu; }  // of the lowest point of the line; negative: behind
  // Distances at which the line is at the altitude, nearer first; none if it never is.
  std::optional<std::array<double, 2>> distancesTo(double altitude_m) const;
};

// Start at an altitude along a zenith cosine.
ShellRay rayFrom(const Medium& medium, double altitude_m, double mu);

// Distance to the ground ahead; none if the ray misses it. On the ground: 0 downwards, none upwards and horizontally.
std::optional<double> distanceToGround(const ShellRay& ray);
// Distance to the altitude of the shell's top, at least that of the start, ahead.
double distanceToTop(const ShellRay& ray, double top_m);
// Where the ray is split within (from, to): both ends, the crossings of altitudes (ascending) and the lowest point. Ascending.
void splitAt(std::span<const double> altitudes_m, const ShellRay& ray, double from, double to, std::vector<double>& out);
// The same at the medium's levels.
std::vector<double> splits(const Medium& medium, const ShellRay& ray, double from, double to);

enum class RayEnd { Ground, Space, Distance };  // what is at the end of a ray

// A ray of the observer's, from where it enters the shell to where it ends, and the sun.
struct LitRay {
  ShellRay ray;
  double length_m;
  RayEnd end;
  glm::dvec3 up, direction, toSun;  // unit, in a frame of the observer's: vertical at the ray's start, the ray, towards the sun's centre
  double sunMu;                     // zenith cosine of the sun at the ray's start
  double cosSun;                    // cosine between the ray and the direction towards the sun

  double sunMuAt(double t) const;  // zenith cosine of the sun at a distance
};

// None if the ray meets no air: it misses the shell, leaves it at once, or ends before it.
std::optional<LitRay> enterShell(const Medium& medium, const ProbeRay& ray);

// Distances in (0, length) at which the sun's disc begins and ends to be cut by the planet's edge, ascending.
// Sources: the cone about the sun's axis that touches the sphere; for a point sun the cylinder.
std::vector<double> terminators(const Medium& medium, const LitRay& ray);

}  // namespace welkin::reference
