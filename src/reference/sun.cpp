#include "welkin/reference/sun.h"

#include <cmath>
#include <numbers>

#include "welkin/reference/columns.h"
#include "welkin/reference/quadrature.h"

namespace welkin::reference {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2;
constexpr Tolerance kDiscTolerance{1e-8, 1e-16};

Spectrum transmittanceToTop(const Medium& medium, double altitude_m, double mu) {
  const auto depth = opticalDepthToTop(medium, altitude_m, mu);
  return depth ? glm::exp(-*depth) : Spectrum(0);
}

// Integral over [-pi/2, pi/2] of a smooth function of period pi that is 0 at the ends: the trapezoid rule, whose error falls faster than
// any power of the number of points (here it is Gauss-Chebyshev quadrature of the second kind). None if 32 points are too few.
template <class Function>
std::optional<Spectrum> periodicIntegral(Function&& f) {
  Spectrum sum = f(0), last = sum * kHalfPi;
  for (int n = 4; n <= 32; n *= 2) {
    for (int i = 1; i < n; i += 2) sum += f((double(i) / n - 0.5) * std::numbers::pi);
    const Spectrum now = sum * (std::numbers::pi / n);
    const Spectrum allowed = glm::max(glm::abs(now) * kDiscTolerance.relative, Spectrum(kDiscTolerance.absolute));
    if (glm::all(glm::lessThanEqual(glm::abs(now - last), allowed))) return now;
    last = now;
  }
  return std::nullopt;
}

// Mean over the sun's disc of `value` (of the zenith cosine), which is 0 below the horizon. The disc is cut into arcs of equal zenith
// angle zeta = theta + x: the half angle of an arc about the zenith is delta, sin^2(delta / 2) = sin((a + x) / 2) sin((a - x) / 2) /
// (sin zeta sin theta) from the cosine theorem, its solid angle 2 delta sin zeta d zeta. x = a sin u takes the roots at both rims away.
template <class Value>
Spectrum meanOverDisc(const Medium& medium, double altitude_m, double muSun, Value&& value) {
  const double a = medium.sunRadius_rad, R = medium.radius_m, theta = std::acos(muSun);
  const double horizon = kHalfPi + std::atan2(std::sqrt(altitude_m * (2 * R + altitude_m)), R);
  if (theta - a >= horizon) return Spectrum(0);
  const double half = std::sin(a / 2), solidAngle = 4 * std::numbers::pi * half * half;
  const auto arc = [&](double u) {  // share of the disc, times the value
    const double x = a * std::sin(u), zeta = theta + x;
    const double sines = std::sin(zeta) * std::sin(theta);
    const double part = std::sin((a + x) / 2) * std::sin((a - x) / 2);
    const double delta = part < sines ? 2 * std::asin(std::sqrt(std::max(part, 0.0) / sines)) : std::numbers::pi;
    return value(std::cos(zeta)) * (2 * delta * std::sin(zeta) * a * std::cos(u) / solidAngle);
  };
  if (theta > 2 * a && theta + a < horizon) {  // a whole disc, away from the zenith: all is smooth and periodic in u
    if (const auto sum = periodicIntegral(arc)) return *sum;
  }
  std::vector<double> breaks{theta < a ? -std::asin(theta / a) : -kHalfPi};  // a disc over the zenith begins there
  const double end = horizon - theta < a ? std::asin((horizon - theta) / a) : kHalfPi;
  if (theta < a) {
    const double rings = std::asin((a - 2 * theta) / a);  // up to there arcs are whole circles
    if (rings > breaks.back() && rings < end) breaks.push_back(rings);
  }
  breaks.push_back(end);
  return integrate(arc, breaks, kDiscTolerance).value;
}

}  // namespace

Spectrum sunTransmittance(const Medium& medium, double altitude_m, double muSun) {
  if (medium.sunRadius_rad == 0) return transmittanceToTop(medium, altitude_m, muSun);
  return meanOverDisc(medium, altitude_m, muSun, [&](double mu) { return transmittanceToTop(medium, altitude_m, mu); });
}

Spectrum sunOnGround(const Medium& medium, double muSun) {
  if (medium.sunRadius_rad == 0) return muSun > 0 ? transmittanceToTop(medium, 0, muSun) * muSun : Spectrum(0);
  return meanOverDisc(medium, 0, muSun, [&](double mu) { return mu > 0 ? transmittanceToTop(medium, 0, mu) * mu : Spectrum(0); });
}

}  // namespace welkin::reference
