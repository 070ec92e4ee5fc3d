#pragma once
// Where light is to be expected: a coarse table that tells the path tracer where collisions are worth while. It changes how fast the
// path tracer converges, never to what.
#include <vector>

#include "welkin/reference/cells.h"

namespace welkin::reference {

class Guide {
 public:
  // `altitudes_m`: of cellAltitudes.
  Guide(const Medium& medium, const std::vector<double>& altitudes_m);

  // What a collision scatters on the average, 1/sr for a solar irradiance of 1: of the sun's direct light, and of light of the next two
  // orders as if all phase functions were isotropic. About right; linear between the table's points.
  Spectrum direct(double altitude_m, double muSun) const { return at(direct_, altitude_m, muSun); }
  Spectrum ambient(double altitude_m, double muSun) const { return at(ambient_, altitude_m, muSun); }
  // Radiance of the ground, its albedo left out.
  Spectrum ground(double muSun) const;

 private:
  Spectrum at(const std::vector<Spectrum>& table, double altitude_m, double muSun) const;
  std::vector<Spectrum> gathered(const Medium& medium, const std::vector<double>& altitudes_m) const;

  double top_m_;
  std::vector<Spectrum> direct_, ambient_;
};

}  // namespace welkin::reference
