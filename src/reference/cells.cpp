#include "welkin/reference/cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace welkin::reference {
namespace {

constexpr std::array kNode{-0.774596669241483377, 0.0, 0.774596669241483377};  // Gauss-Legendre, three points
constexpr std::array kWeight{5.0 / 9, 8.0 / 9, 5.0 / 9};
constexpr double kNegligibleDepth = 1e-6;

// Optical depths of a piece: all, and scattering.
struct Depths {
  Spectrum all{}, scattering{};
};
Depths depths(const Medium& medium, const ShellRay& ray, double from, double to) {
  Depths out;
  const double half = 0.5 * (to - from), centre = 0.5 * (from + to);
  for (int i = 0; i < 3; ++i) {
    const double h = ray.altitudeAt(centre + half * kNode[i]);
    for (const MediumLayer& layer : medium.layers) {
      const double d = density(layer, h) * kWeight[i] * half;
      out.all += layer.extinction * d;
      out.scattering += layer.scattering * d;
    }
  }
  return out;
}

// Is the layer of note at this altitude, and thinner than a step of this size?
bool needsCut(const Medium& medium, const MediumLayer& layer, double base_m, double step_m) {
  if (layer.profile != Profile::Exponential || step_m * layer.a <= 1) return false;
  const double strongest = std::max({layer.extinction.x, layer.extinction.y, layer.extinction.z});
  const double horizontal_m = std::sqrt(2 * std::numbers::pi * (medium.radius_m + base_m) / layer.a) + 1 / layer.a;  // Chapman's, about
  return strongest * density(layer, base_m) * horizontal_m > kNegligibleDepth;
}

}  // namespace

std::vector<double> cellAltitudes(const Medium& medium) {
  std::vector<double> out;
  double base = 0;
  std::vector<double> ends = medium.levels_m;
  ends.push_back(medium.top_m);
  for (const double end : ends) {
    while (true) {
      double next = end;
      for (const MediumLayer& layer : medium.layers)
        if (needsCut(medium, layer, base, next - base)) next = base + 1 / layer.a;
      if (!(next < end)) break;
      if (!(next > base)) break;  // a scale height below the spacing of doubles here
      out.push_back(base = next);
    }
    base = end;
    if (end < medium.top_m) out.push_back(end);
  }
  return out;
}

void cutRay(const Medium& medium, const std::vector<double>& altitudes_m, const ShellRay& ray, double length_m, Cells& out) {
  splitAt(altitudes_m, ray, 0, length_m, out.edge_m);
  out.depth.assign(1, Spectrum(0));
  out.scattering.clear();
  for (std::size_t i = 0; i + 1 < out.edge_m.size(); ++i) {
    const Depths d = depths(medium, ray, out.edge_m[i], out.edge_m[i + 1]);
    out.depth.push_back(out.depth.back() + d.all);
    out.scattering.push_back(d.scattering);
  }
}

Spectrum depthWithin(const Medium& medium, const ShellRay& ray, double from_m, double to_m) {
  return depths(medium, ray, from_m, to_m).all;
}

Spectrum quickTransmittance(const Medium& medium, const std::vector<double>& altitudes_m, double altitude_m, double mu,
                            std::vector<double>& scratch) {
  const ShellRay ray = rayFrom(medium, altitude_m, mu);
  if (distanceToGround(ray)) return Spectrum(0);
  splitAt(altitudes_m, ray, 0, distanceToTop(ray, medium.top_m), scratch);
  Spectrum depth{};
  for (std::size_t i = 0; i + 1 < scratch.size(); ++i) depth += depths(medium, ray, scratch[i], scratch[i + 1]).all;
  return glm::exp(-depth);
}

}  // namespace welkin::reference
