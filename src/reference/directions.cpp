#include "welkin/reference/directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace welkin::reference {
namespace {

// Henyey and Greenstein's inversion, 2 u - 1 = v, without the division by g: c = (v (1 + g^2) + g (v^2 (1 + g^2) + 3 - g^2) / 2) / (1 + g
// v)^2.
double henyeyGreenstein(double g, double u) {
  const double v = 2 * u - 1, s = 1 + g * g, d = 1 + g * v;
  return std::clamp((v * s + 0.5 * g * (v * v * s + 3 - g * g)) / (d * d), -1.0, 1.0);
}

}  // namespace

double samplePhase(PhaseType type, double g, PathNumbers& numbers) {
  double u = numbers.next();
  switch (type) {
    case PhaseType::Rayleigh: {  // c^3 + 3 c = 8 u - 4, by Cardano
      const double z = 4 * u - 2, root = std::cbrt(z + std::sqrt(z * z + 1));
      return std::clamp(root - 1 / root, -1.0, 1.0);
    }
    case PhaseType::HenyeyGreenstein:
      return henyeyGreenstein(g, u);
    case PhaseType::CornetteShanks:  // Henyey-Greenstein times (1 + c^2) / 2, which is at most 1: rejection
      while (true) {
        const double c = henyeyGreenstein(g, u);
        if (2 * numbers.plain() < 1 + c * c) return c;
        u = numbers.plain();
      }
    case PhaseType::Isotropic:
      break;
  }
  return 2 * u - 1;
}

glm::dvec3 directionAbout(glm::dvec3 axis, double cosine, double turn) {
  // Frame of Duff et al. 2017: no pole but the sign's
  const double sign = std::copysign(1.0, axis.z), a = -1 / (sign + axis.z), b = axis.x * axis.y * a;
  const glm::dvec3 side(1 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x), other(b, sign + axis.y * axis.y * a, -axis.y);
  const double sine = std::sqrt(std::max((1 - cosine) * (1 + cosine), 0.0)), angle = 2 * std::numbers::pi * turn;
  return glm::normalize(axis * cosine + side * (sine * std::cos(angle)) + other * (sine * std::sin(angle)));
}

}  // namespace welkin::reference
