#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>

#include "welkin/clouds/cover_map.h"
#include "welkin/shared/noise.glsl.h"

namespace welkin {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

glm::uvec3 fixedOf(glm::dvec3 d) {
  return {static_cast<std::uint32_t>((d.x * 0.499 + 0.5) * 0x1p32), static_cast<std::uint32_t>((d.y * 0.499 + 0.5) * 0x1p32),
          static_cast<std::uint32_t>((d.z * 0.499 + 0.5) * 0x1p32)};
}

// Sum of octaves whose first cell is 2^shift steps (2^30: 3200 km on an Earth); standard deviation about 0.4.
double fbm(glm::dvec3 d, std::uint32_t shift, std::uint32_t octaves, std::uint32_t seed, double gain = 0.55) {
  const glm::uvec3 p = fixedOf(d);
  double n = 0, amplitude = 1;
  for (std::uint32_t k = 0; k < octaves; ++k, amplitude *= gain)
    n += amplitude * static_cast<double>(shared::noise3(p, shift - k, shift - k, shared::octaveSeed(seed, k)));
  return n;
}

double bump(double x, double centre, double width) { return std::exp(-(x - centre) * (x - centre) / (width * width)); }

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

ProceduralWeather::ProceduralWeather(std::uint32_t seed) : seed_(shared::mixBits(seed + 0x3C6EF372u)) {
  std::uint32_t state = seed_;
  const auto random = [&](double low, double high) {
    state = shared::mixBits(state + 0x9E3779B9u);
    return low + (high - low) * static_cast<double>(state) / 0x1p32;
  };
  // Eight extratropical cyclones along each storm track and two tropical ones a hemisphere; winds turn left in the north.
  for (int south = 0; south < 2; ++south)
    for (int i = 0; i < 10; ++i) {
      const bool tropical = i >= 8;
      const double latitude = kDegree * (tropical ? random(11, 20) : random(40, 63)) * (south ? -1 : 1);
      const double longitude = kDegree * (tropical ? random(0, 360) : i * 45 + random(-15, 15));
      Cyclone c;
      c.centre = {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude), std::sin(latitude)};
      c.radius_rad = kDegree * (tropical ? random(3, 5) : random(7, 13));
      c.turn = (south ? -1 : 1) * (tropical ? random(5, 6.5) : random(2.6, 4.2));
      c.strength = tropical ? 1.0 : random(0.55, 0.9);
      c.phase = random(0, 2 * std::numbers::pi);
      cyclones_.push_back(c);
    }
}

float ProceduralWeather::at(glm::dvec3 direction_planet) const {
  glm::dvec3 d = direction_planet;
  double arms = 0, eye = 1;
  for (const Cyclone& c : cyclones_) {
    const double cosine = glm::dot(direction_planet, c.centre);
    if (cosine < std::cos(3 * c.radius_rad)) continue;
    const double s = std::acos(std::min(cosine, 1.0)) / c.radius_rad;
    const double near = std::exp(-s * s);
    // the field of clouds is wound up around the centre
    d = glm::angleAxis(-c.turn * near, c.centre) * d;
    // two logarithmic arms, one of them stronger, that fade outwards
    const glm::dvec3 east = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), c.centre));
    const glm::dvec3 north = glm::cross(c.centre, east);
    const double angle = std::atan2(glm::dot(direction_planet, north), glm::dot(direction_planet, east));
    const double wind = (c.turn > 0 ? 1 : -1) * angle + 2.6 * std::log(s + 0.08) + c.phase;
    const double band = 0.62 * (0.5 + 0.5 * std::cos(wind)) + 0.38 * (0.5 + 0.5 * std::cos(2 * wind + 1));
    arms += c.strength * near * (1.5 * smooth(0.42, 0.8, band) - 0.45);
    eye *= 1 - 0.9 * std::exp(-s * s / 0.006);
  }
  const double latitude = std::asin(std::clamp(d.z, -1.0, 1.0)) / kDegree;
  // Mean cover by latitude: rain belt, dry subtropics, storm tracks (after zonal means of satellite cloud climatologies).
  const double sway = 5 * fbm(d, 30, 2, seed_ + 11);
  const double lean = std::abs(latitude + sway);
  const double zone = 0.42 * bump(latitude + sway, 6, 7) + 0.5 * bump(lean, 56, 17) + 0.3 * bump(lean, 85, 18) - 0.16 * bump(lean, 24, 10);
  // Fronts and masses: the noise is itself displaced by slower noise, which draws it out into filaments.
  const glm::dvec3 drift{fbm(d, 30, 3, seed_ + 1), fbm(d, 30, 3, seed_ + 2), 0.5 * fbm(d, 30, 3, seed_ + 3)};
  const glm::dvec3 q = glm::normalize(d + 0.22 * drift);
  const double masses = fbm(q, 30, 6, seed_ + 4, 0.58);
  const double texture = fbm(glm::normalize(d + 0.06 * drift), 27, 5, seed_ + 5, 0.65);
  const double wet = 0.95 * masses + zone - 0.14 + 0.55 * arms;
  const double cover = smooth(-0.1, 0.8, wet + 0.3 * texture * smooth(-0.5, 0.3, wet));
  return static_cast<float>(std::clamp(cover * eye, 0.0, 1.0));
}

}  // namespace welkin
