#include "welkin/physics/air.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace welkin {
namespace {

constexpr double kNothing = 1e-8;  // optical depth of the longest path that counts as none: 1/4000 of 16 bits

Result<void> setProfile(shared::AirLayer& out, const AirLayer& in) {
  const auto wrong = [&](const char* what) { return Error{"atmosphere layer '" + in.name + "': " + what}; };
  if (const auto* e = std::get_if<ExponentialProfile>(&in.profile)) {
    if (!(e->scaleHeight_m > 0)) return wrong("scale_height_m must be greater than 0");
    out.profile = shared::kProfileExponential;
    out.a = static_cast<float>(1 / e->scaleHeight_m);
  } else if (const auto* t = std::get_if<TentProfile>(&in.profile)) {
    if (!(t->halfWidth_m > 0)) return wrong("half_width_m must be greater than 0");
    out.profile = shared::kProfileTent;
    out.a = static_cast<float>(t->peak_m);
    out.b = static_cast<float>(1 / t->halfWidth_m);
  } else if (const auto* u = std::get_if<UniformProfile>(&in.profile)) {
    if (!(u->top_m > u->base_m)) return wrong("top_m must be greater than base_m");
    out.profile = shared::kProfileUniform;
    out.a = static_cast<float>(u->base_m);
    out.b = static_cast<float>(u->top_m);
  }
  return {};
}

// Legendre moments of phase functions, chi_l = integral of p P_l over the sphere, and the part `forward` of a peaked one that series up
// to `degree` cannot hold: it counts as not scattered (delta-M, Wiscombe 1977). Cornette-Shanks is 3/(2 (2 + g^2)) (1 + c^2) times
// Henyey-Greenstein, whose moments are g^l, and c P_l = ((l + 1) P_l+1 + l P_l-1) / (2 l + 1).
void setMoments(shared::AirLayer& out, const AirLayer& in, int degree) {
  constexpr int kMoments = 16;
  const auto hg = [&](int l) { return std::pow(in.g, std::abs(l)); };
  const auto timesCosine = [](int l, auto&& moment) { return ((l + 1) * moment(l + 1) + (l > 0 ? l * moment(l - 1) : 0.0)) / (2 * l + 1); };
  const auto moment = [&](int l) -> double {
    if (in.phase == PhaseType::Isotropic) return l == 0;
    if (in.phase == PhaseType::Rayleigh) return l == 0 ? 1 : l == 2 ? 0.1 : 0;
    if (in.phase == PhaseType::HenyeyGreenstein) return hg(l);
    const auto once = [&](int k) { return timesCosine(k, hg); };
    return 1.5 / (2 + in.g * in.g) * (hg(l) + timesCosine(l, once));
  };
  for (int l = 0; l < kMoments; ++l) out.moments[l / 4][l % 4] = static_cast<float>(moment(l));
  out.forward = degree > 0 && degree + 1 < kMoments ? static_cast<float>(std::max(moment(degree + 1), 0.0)) : 0.0f;
}

Result<shared::AirLayer> layerOf(const AirLayer& in, int degree) {
  shared::AirLayer out{};
  if (auto r = setProfile(out, in); !r) return r.error();
  for (std::size_t i = 0; i < 3; ++i)
    if (!(in.scattering_per_m[i] >= 0) || !(in.absorption_per_m[i] >= 0))
      return Error{"atmosphere layer '" + in.name + "': scattering_per_m and absorption_per_m must not be negative"};
  if (!(std::abs(in.g) < 1)) return Error{"atmosphere layer '" + in.name + "': g must lie between -1 and 1"};
  const auto f = [](double v) { return static_cast<float>(v); };
  out.scatteringR = f(in.scattering_per_m[0]), out.scatteringG = f(in.scattering_per_m[1]), out.scatteringB = f(in.scattering_per_m[2]);
  out.absorptionR = f(in.absorption_per_m[0]), out.absorptionG = f(in.absorption_per_m[1]), out.absorptionB = f(in.absorption_per_m[2]);
  out.g = f(in.g);
  setMoments(out, in, degree);
  switch (in.phase) {
    case PhaseType::Rayleigh:
      out.phase = shared::kPhaseRayleigh;
      break;
    case PhaseType::CornetteShanks:
      out.phase = shared::kPhaseCornetteShanks;
      break;
    case PhaseType::HenyeyGreenstein:
      out.phase = shared::kPhaseHenyeyGreenstein;
      break;
    case PhaseType::Isotropic:
      out.phase = shared::kPhaseIsotropic;
      break;
  }
  return out;
}

}  // namespace

bool isPeaked(const shared::AirLayer& l) {
  return (l.phase == shared::kPhaseCornetteShanks || l.phase == shared::kPhaseHenyeyGreenstein) && std::abs(l.g) > 0.3f;
}

Atmosphere earthAir() {
  return {100'000,
          "auto",
          {{"rayleigh", ExponentialProfile{8000}, {5.802e-6, 13.558e-6, 33.1e-6}, {}, PhaseType::Rayleigh, 0},
           {"mie", ExponentialProfile{1200}, {3.996e-6, 3.996e-6, 3.996e-6}, {0.444e-6, 0.444e-6, 0.444e-6}, PhaseType::CornetteShanks, 0.8},
           {"ozone", TentProfile{25'000, 15'000}, {}, {0.650e-6, 1.881e-6, 0.085e-6}, PhaseType::Isotropic, 0}}};
}

double layerThickness_m(const AirLayer& layer) {
  if (const auto* e = std::get_if<ExponentialProfile>(&layer.profile)) return e->scaleHeight_m;
  if (const auto* t = std::get_if<TentProfile>(&layer.profile)) return t->halfWidth_m;
  const auto& u = std::get<UniformProfile>(layer.profile);
  return u.top_m - u.base_m;
}

double airTop_m(const Scene& scene) {
  const Atmosphere& a = *scene.atmosphere;
  double top = 0;
  for (const AirLayer& layer : a.layers) {
    double greatest = 0;
    for (std::size_t c = 0; c < 3; ++c) greatest = std::max(greatest, layer.scattering_per_m[c] + layer.absorption_per_m[c]);
    if (const auto* e = std::get_if<ExponentialProfile>(&layer.profile)) {
      // A path that touches altitude h meets exp(-h / H) times sqrt(2 pi r H) (Chapman) of air, where that is flat; else less than 2 H more.
      const double path = std::sqrt(2 * std::numbers::pi * (scene.planet.radius_m + a.top_m) * e->scaleHeight_m) + 2 * e->scaleHeight_m;
      top = std::max(top, e->scaleHeight_m * std::log(std::max(greatest * path / kNothing, 1.0)));
    }
    if (const auto* t = std::get_if<TentProfile>(&layer.profile)) top = std::max(top, t->peak_m + t->halfWidth_m);
    if (const auto* u = std::get_if<UniformProfile>(&layer.profile)) top = std::max(top, u->top_m);
  }
  return top > 0 ? std::min(top, a.top_m) : a.top_m;
}

Result<shared::AirBlock> airBlock(const Scene& scene, int degree) {
  if (!scene.atmosphere) return Error{"the scene has no atmosphere"};
  const Atmosphere& atmosphere = *scene.atmosphere;
  if (atmosphere.layers.size() > shared::kMaxAirLayers)
    return Error{"atmosphere: at most " + std::to_string(shared::kMaxAirLayers) + " layers, found " +
                 std::to_string(atmosphere.layers.size())};
  if (!(atmosphere.top_m > 0) || !(scene.planet.radius_m > 0))
    return Error{"atmosphere: top_m and the planet's radius_m must be greater than 0"};
  shared::AirBlock block{};
  shared::AirParams& p = block.params;
  p.radius_m = static_cast<float>(scene.planet.radius_m);
  const double top_m = airTop_m(scene);
  p.top_m = static_cast<float>(top_m);
  p.layerCount = static_cast<std::uint32_t>(atmosphere.layers.size());
  p.peakLayer = shared::kNoLayer;
  if (scene.sun) {
    p.sunRadius_rad = static_cast<float>(scene.sun->angularRadius_rad);
    p.sunR = static_cast<float>(scene.sun->irradiance[0]);
    p.sunG = static_cast<float>(scene.sun->irradiance[1]);
    p.sunB = static_cast<float>(scene.sun->irradiance[2]);
  }
  p.albedoR = static_cast<float>(scene.planet.albedo[0]);
  p.albedoG = static_cast<float>(scene.planet.albedo[1]);
  p.albedoB = static_cast<float>(scene.planet.albedo[2]);
  p.sunCos = std::cos(p.sunRadius_rad);
  p.sunSin = std::sin(p.sunRadius_rad);
  double scale_m = top_m;
  for (const AirLayer& layer : atmosphere.layers) scale_m = std::min(scale_m, layerThickness_m(layer));
  p.altitudeScale_m = static_cast<float>(scale_m);
  p.altitudeNorm = static_cast<float>(1 / std::log1p(top_m / scale_m));
  // A point sees light that was scattered once while the sun is less than twice the dip of the shell's horizon below its own; three
  // times leaves room for higher orders, of which four dips away nothing is left.
  const double dip = std::acos(scene.planet.radius_m / (scene.planet.radius_m + top_m));
  p.sunNight = static_cast<float>(std::sin(std::min(3 * dip, std::numbers::pi / 2)));
  p.sunBend = 3;
  float strongest = 0;
  for (std::uint32_t i = 0; i < p.layerCount; ++i) {
    auto layer = layerOf(atmosphere.layers[i], degree);
    if (!layer) return layer.error();
    block.layers[i] = *layer;
    if (!isPeaked(*layer) || layer->scatteringG <= strongest) continue;
    strongest = layer->scatteringG;
    p.peakLayer = i;
    p.peakPhase = layer->phase;
    p.peakG = layer->g;
  }
  // Of the shell's height, where an optical depth of 1 (550 nm) lies above: paths from higher up end near there, not at the ground.
  if (p.layerCount > 0 && scene.planet.radius_m > 0) {
    const auto above = [&](double h) { return shared::airOpticalDepthToTop(block, static_cast<float>(h), 1, 40).y; };
    double low = 0, high = above(0) > 1 ? top_m : 0;
    for (int i = 0; i < 20; ++i) (above(0.5 * (low + high)) > 1 ? low : high) = 0.5 * (low + high);
    block.params.hazeTop = static_cast<float>(std::min(3 * high / top_m, 1.0));
  }
  return block;
}

shared::AirViewFrame airViewFrame(const shared::AirParams& air, double centre_m, double altitude_m, glm::dvec3 up, glm::dvec3 toSun) {
  const double radius = air.radius_m, top = air.top_m;
  const bool outside = altitude_m > top;
  const double anchor = outside ? top : std::max(altitude_m, 0.0);
  const double muHorizon = -std::sqrt(anchor * (2 * radius + anchor)) / (radius + anchor);
  const double cosSun = std::clamp(glm::dot(up, toSun), -1.0, 1.0);
  glm::dvec3 axis = toSun - up * cosSun;
  if (!(glm::dot(axis, axis) > 0))
    axis = glm::cross(up, std::abs(up.z) < 0.5 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0));  // any: sun overhead
  axis = glm::normalize(axis);
  const auto f = [](double v) { return static_cast<float>(v); };
  shared::AirViewFrame v{};
  v.upX = f(up.x), v.upY = f(up.y), v.upZ = f(up.z);
  v.axisX = f(axis.x), v.axisY = f(axis.y), v.axisZ = f(axis.z);
  v.sunX = f(toSun.x), v.sunY = f(toSun.y), v.sunZ = f(toSun.z);
  v.muHorizon = f(muHorizon);
  v.skyEnd = outside ? 1.0f : 0.0f;  // entering rays descend: their zenith cosine ends at 0
  v.skyChord = f(std::sqrt(1 - muHorizon));
  v.groundChord = f(std::sqrt(1 + muHorizon));
  v.anchorAltitude_m = f(anchor);
  v.skySlices = f(anchor / top - 1);               // dense near a camera in thick air, even through the limb
  v.groundSlices = f(anchor / (anchor + 10'000) * (1 - air.hazeTop));  // dense near the ground for a camera above air that is thick there
  v.cosSun = f(cosSun);
  v.sinSun = f(std::sqrt(1 - cosSun * cosSun));
  v.anchorOverCentre = outside ? f((radius + top) / centre_m) : 1.0f;
  return v;
}

}  // namespace welkin
