#include "welkin/reference/medium.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace welkin::reference {
namespace {

constexpr double kPi = std::numbers::pi;

Result<MediumLayer> layerOf(const AirLayer& in) {
  const auto wrong = [&](const char* what) { return Error{"atmosphere layer '" + in.name + "': " + what}; };
  MediumLayer out;
  if (const auto* e = std::get_if<ExponentialProfile>(&in.profile)) {
    if (!(e->scaleHeight_m > 0)) return wrong("scale_height_m must be greater than 0");
    out.profile = Profile::Exponential;
    out.a = 1 / e->scaleHeight_m;
  } else if (const auto* t = std::get_if<TentProfile>(&in.profile)) {
    if (!(t->halfWidth_m > 0)) return wrong("half_width_m must be greater than 0");
    out.profile = Profile::Tent;
    out.a = t->peak_m, out.b = 1 / t->halfWidth_m;
  } else if (const auto* u = std::get_if<UniformProfile>(&in.profile)) {
    if (!(u->top_m > u->base_m)) return wrong("top_m must be greater than base_m");
    out.profile = Profile::Uniform;
    out.a = u->base_m, out.b = u->top_m;
  }
  for (std::size_t i = 0; i < 3; ++i)
    if (!(in.scattering_per_m[i] >= 0) || !(in.absorption_per_m[i] >= 0))
      return wrong("scattering_per_m and absorption_per_m must not be negative");
  if (!(std::abs(in.g) < 1)) return wrong("g must lie between -1 and 1");
  out.scattering = spectrum(in.scattering_per_m);
  out.extinction = out.scattering + spectrum(in.absorption_per_m);
  out.phase = in.phase, out.g = in.g;
  return out;
}

void addLevels(std::vector<double>& levels, const MediumLayer& layer, double top_m) {
  switch (layer.profile) {
    case Profile::Exponential:
      // Past 64 scale heights nothing is left to see (1e-28 of the ground's density).
      for (const double multiple : {1.0, 4.0, 16.0, 64.0}) levels.push_back(multiple / layer.a);
      break;
    case Profile::Tent:
      for (const double side : {-1.0, 0.0, 1.0}) levels.push_back(layer.a + side / layer.b);
      break;
    case Profile::Uniform:
      levels.push_back(layer.a);
      levels.push_back(layer.b);
      break;
  }
  std::erase_if(levels, [&](double h) { return !(h > 0 && h < top_m); });
}

}  // namespace

double density(const MediumLayer& layer, double altitude_m) {
  switch (layer.profile) {
    case Profile::Exponential:
      return std::exp(-altitude_m * layer.a);
    case Profile::Tent:
      return std::max(0.0, 1 - std::abs(altitude_m - layer.a) * layer.b);
    case Profile::Uniform:
      break;
  }
  return altitude_m >= layer.a && altitude_m <= layer.b ? 1 : 0;
}

Result<Medium> makeMedium(const Scene& scene) {
  if (!scene.atmosphere) return Error{"the scene has no atmosphere"};
  Medium out;
  out.radius_m = scene.planet.radius_m, out.top_m = scene.atmosphere->top_m;
  if (!(out.radius_m > 0)) return Error{"planet: radius_m must be greater than 0"};
  if (!(out.top_m > 0)) return Error{"atmosphere: top_m must be greater than 0"};
  out.albedo = spectrum(scene.planet.albedo);
  out.sunRadius_rad = scene.sun ? scene.sun->angularRadius_rad : Sun{}.angularRadius_rad;
  for (const AirLayer& in : scene.atmosphere->layers) {
    auto layer = layerOf(in);
    if (!layer) return layer.error();
    addLevels(out.levels_m, *layer, out.top_m);
    out.layers.push_back(*layer);
  }
  std::sort(out.levels_m.begin(), out.levels_m.end());
  out.levels_m.erase(std::unique(out.levels_m.begin(), out.levels_m.end()), out.levels_m.end());
  return out;
}

double phase(PhaseType type, double g, double c) {
  // 1 + g^2 - 2 g c without cancellation where it is small
  const double a = (1 - g) * (1 - g) + 2 * g * (1 - c);
  switch (type) {
    case PhaseType::Rayleigh:
      return 3 / (16 * kPi) * (1 + c * c);
    case PhaseType::CornetteShanks:
      return 3 / (8 * kPi) * (1 - g * g) * (1 + c * c) / ((2 + g * g) * a * std::sqrt(a));
    case PhaseType::HenyeyGreenstein:
      return (1 - g * g) / (4 * kPi * a * std::sqrt(a));
    case PhaseType::Isotropic:
      break;
  }
  return 1 / (4 * kPi);
}

Spectrum extinction(const Medium& medium, double altitude_m) {
  Spectrum sum{};
  for (const MediumLayer& layer : medium.layers) sum += layer.extinction * density(layer, altitude_m);
  return sum;
}

Spectrum scatteringTowards(const Medium& medium, double altitude_m, double c) {
  Spectrum sum{};
  for (const MediumLayer& layer : medium.layers) sum += layer.scattering * (density(layer, altitude_m) * phase(layer.phase, layer.g, c));
  return sum;
}

}  // namespace welkin::reference
