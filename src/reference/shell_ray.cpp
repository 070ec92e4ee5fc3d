#include "welkin/reference/shell_ray.h"

#include <algorithm>
#include <cmath>

namespace welkin::reference {
namespace {

// Roots of t^2 + 2 b t + c = 0 with known root of the discriminant, ascending.
std::array<double, 2> rootsOf(double b, double c, double root) {
  const double q = b > 0 ? -b - root : -b + root;  // the root of greater magnitude
  const double other = q != 0 ? c / q : 0;
  return q < other ? std::array{q, other} : std::array{other, q};
}

}  // namespace

double ShellRay::radiusAt(double t) const {
  const double r = startRadius_m();
  return std::sqrt(std::max(r * r + t * (2 * r * mu + t), 0.0));
}

double ShellRay::altitudeAt(double t) const {
  const double h = (altitude_m * (2 * radius_m + altitude_m) + t * (2 * startRadius_m() * mu + t)) / (radiusAt(t) + radius_m);
  return std::max(h, 0.0);
}

std::optional<std::array<double, 2>> ShellRay::distancesTo(double h) const {
  const double square = (radius_m + h - impact_m) * (radius_m + h + impact_m);
  if (!(square > 0)) return std::nullopt;
  return rootsOf(startRadius_m() * mu, (altitude_m - h) * (2 * radius_m + altitude_m + h), std::sqrt(square));
}

ShellRay rayFrom(const Medium& medium, double altitude_m, double mu) {
  const double sine = std::sqrt(std::max((1 - mu) * (1 + mu), 0.0));
  return {medium.radius_m, altitude_m, mu, (medium.radius_m + altitude_m) * sine};
}

std::optional<double> distanceToGround(const ShellRay& ray) {
  if (ray.mu >= 0) return std::nullopt;
  const auto both = ray.distancesTo(0);
  if (!both) return std::nullopt;
  return std::max((*both)[0], 0.0);
}

double distanceToTop(const ShellRay& ray, double top_m) {
  const auto both = ray.distancesTo(top_m);
  return both ? std::max((*both)[1], 0.0) : 0;
}

void splitAt(std::span<const double> altitudes_m, const ShellRay& ray, double from, double to, std::vector<double>& out) {
  out.assign(1, from);
  const auto add = [&](double t) {
    if (t > out.back() && t < to) out.push_back(t);
  };
  if (from < ray.tangentDistance_m())
    for (auto h = altitudes_m.rbegin(); h != altitudes_m.rend(); ++h)
      if (const auto both = ray.distancesTo(*h)) add((*both)[0]);
  add(ray.tangentDistance_m());
  if (to > ray.tangentDistance_m())
    for (const double h : altitudes_m)
      if (const auto both = ray.distancesTo(h)) add((*both)[1]);
  if (to > from) out.push_back(to);
}

std::vector<double> splits(const Medium& medium, const ShellRay& ray, double from, double to) {
  std::vector<double> out;
  out.reserve(2 * medium.levels_m.size() + 3);
  splitAt(medium.levels_m, ray, from, to, out);
  return out;
}

double LitRay::sunMuAt(double t) const { return std::clamp((ray.startRadius_m() * sunMu + t * cosSun) / ray.radiusAt(t), -1.0, 1.0); }

std::optional<LitRay> enterShell(const Medium& medium, const ProbeRay& in) {
  const double R = medium.radius_m, top = medium.top_m;
  const double h = std::max(in.altitude_m, 0.0), r = R + h;
  const double mu = std::cos(in.viewZenith_rad), sine = std::sin(in.viewZenith_rad), impact = r * sine;
  const double sunMu = std::cos(in.sunZenith_rad), sunSine = std::sin(in.sunZenith_rad);
  const double cosSun = std::clamp(mu * sunMu + sine * sunSine * std::cos(in.azimuth_rad), -1.0, 1.0);
  LitRay out{{R, h, mu, impact}, 0, RayEnd::Space, {0, 0, 1}, {sine, 0, mu}, {}, sunMu, cosSun};
  out.toSun = {sunSine * std::cos(in.azimuth_rad), sunSine * std::sin(in.azimuth_rad), sunMu};
  double before = 0;  // distance up to the shell
  if (h >= top) {
    if (mu >= 0 || impact >= R + top) return std::nullopt;
    before = (*out.ray.distancesTo(top))[0];
    const double root = std::sqrt((R + top - impact) * (R + top + impact));
    out.ray = {R, top, -root / (R + top), impact};
    out.up = (r * out.up + before * out.direction) / (R + top);
    out.sunMu = std::clamp((r * sunMu + before * cosSun) / (R + top), -1.0, 1.0);
  }
  if (const auto ground = distanceToGround(out.ray)) {
    out.length_m = *ground;
    out.end = RayEnd::Ground;
  } else {
    out.length_m = distanceToTop(out.ray, top);
  }
  const double left = in.maxDistance_m - before;
  if (left < out.length_m) {
    out.length_m = left;
    out.end = RayEnd::Distance;
  }
  if (out.length_m < 0 || (out.length_m == 0 && out.end != RayEnd::Ground)) return std::nullopt;
  return out;
}

std::vector<double> terminators(const Medium& medium, const LitRay& lit) {
  std::vector<double> out;
  const double a = medium.sunRadius_rad, R = lit.ray.radius_m, r = lit.ray.startRadius_m();
  const double square = lit.ray.altitude_m * (2 * R + lit.ray.altitude_m);  // r^2 - R^2
  for (const double tilt : {-a, a}) {
    // (x.s + R sin tilt)^2 = cos^2 tilt (r^2 - R^2); the other sheet of the cone splits where nothing is, which does no harm
    const double cos2 = std::cos(tilt) * std::cos(tilt), k = r * lit.sunMu + R * std::sin(tilt);
    const double A = lit.cosSun * lit.cosSun - cos2, B = lit.cosSun * k - cos2 * r * lit.ray.mu, C = k * k - cos2 * square;
    const double discriminant = B * B - A * C;
    if (A == 0 || !(discriminant >= 0)) continue;
    for (const double t : rootsOf(B / A, C / A, std::sqrt(discriminant) / std::abs(A)))
      if (t > 0 && t < lit.length_m) out.push_back(t);
    if (a == 0) break;
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace welkin::reference
