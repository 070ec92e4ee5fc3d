#pragma once
// The clear air of a scene in double precision, and its phase functions.
#include <glm/glm.hpp>
#include <vector>

#include "welkin/core/result.h"
#include "welkin/physics/scene.h"

namespace welkin::reference {

using Spectrum = glm::dvec3;  // values at 680, 550, 440 nm
inline Spectrum spectrum(const Spectrum3& v) { return {v[0], v[1], v[2]}; }
inline Spectrum3 spectrum3(const Spectrum& v) { return {v.x, v.y, v.z}; }

enum class Profile { Exponential, Tent, Uniform };

struct MediumLayer {
  Profile profile = Profile::Exponential;
  double a = 0, b = 0;                  // 1 / scale height; peak [m] and 1 / half width; base and top [m]
  Spectrum scattering{}, extinction{};  // 1/m where the profile is 1
  PhaseType phase = PhaseType::Rayleigh;
  double g = 0;
};

// Fraction of the layer's greatest density at an altitude of at least 0 [m].
double density(const MediumLayer& layer, double altitude_m);

struct Medium {
  double radius_m = 0, top_m = 0;  // of the ground; height of the shell
  std::vector<MediumLayer> layers;
  Spectrum albedo{};         // Lambert, one for the whole planet: an albedo map is left out
  double sunRadius_rad = 0;  // 0: a point
  // Altitudes in (0, top) where rays are split, ascending: corners of profiles, and multiples 1, 4, 16, 64 of each scale height, so that
  // a quadrature of 15 points on a piece sees the decay.
  std::vector<double> levels_m;
};

// One line of error without an atmosphere or with a layer out of range.
Result<Medium> makeMedium(const Scene& scene);

// Phase functions, 1/sr, integrating to 1 over the sphere; `c` is the cosine of the scattering angle.
// Rayleigh 3/(16 pi) (1 + c^2); Henyey and Greenstein 1941; Cornette and Shanks 1992; isotropic.
double phase(PhaseType type, double g, double c);

// Coefficients at an altitude [1/m].
Spectrum extinction(const Medium& medium, double altitude_m);
// Sum over layers of scattering times phase function [1/(m sr)].
Spectrum scatteringTowards(const Medium& medium, double altitude_m, double c);

}  // namespace welkin::reference
