#include "guide.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "welkin/reference/directions.h"

namespace welkin::reference {
namespace {

constexpr int kAltitudes = 20, kSuns = 64;
constexpr double kPi = std::numbers::pi;

// The sun's zenith cosine over a row of the table, five times as dense at the horizon as on average; altitudes as squares.
double sunOf(int i) {
  const double v = 2.0 * i / (kSuns - 1) - 1;
  return v / (5 - 4 * std::abs(v));
}
double sunPlace(double mu) { return (0.5 + 2.5 * mu / (1 + 4 * std::abs(mu))) * (kSuns - 1); }
double altitudeOf(int j, double top_m) { return top_m * j * j / ((kAltitudes - 1.0) * (kAltitudes - 1.0)); }
double altitudePlace(double h, double top_m) { return std::sqrt(std::clamp(h / top_m, 0.0, 1.0)) * (kAltitudes - 1); }

}  // namespace

Guide::Guide(const Medium& medium, const std::vector<double>& altitudes_m) : top_m_(medium.top_m) {
  std::vector<double> scratch;
  for (int j = 0; j < kAltitudes; ++j)
    for (int i = 0; i < kSuns; ++i)
      direct_.push_back(quickTransmittance(medium, altitudes_m, altitudeOf(j, top_m_), sunOf(i), scratch) / (4 * kPi));
  ambient_.assign(direct_.size(), Spectrum(0));
  for (int order = 2; order <= 3; ++order) ambient_ = gathered(medium, altitudes_m);
}

Spectrum Guide::ground(double muSun) const {
  // Irradiance over pi: 4 pi times `direct` times the cosine, and of isotropic light from above
  return direct(0, muSun) * (4 * std::max(muSun, 0.0)) + ambient(0, muSun);
}

Spectrum Guide::at(const std::vector<Spectrum>& table, double altitude_m, double muSun) const {
  const double x = sunPlace(muSun), y = altitudePlace(altitude_m, top_m_);
  const int i = std::clamp(int(x), 0, kSuns - 2), j = std::clamp(int(y), 0, kAltitudes - 2);
  const double u = x - i, v = y - j;
  const Spectrum* row = &table[std::size_t(j) * kSuns + i];
  return (row[0] * (1 - u) + row[1] * u) * (1 - v) + (row[kSuns] * (1 - u) + row[kSuns + 1] * u) * v;
}

// What arrives at the table's points from collisions as the tables now have them: mean over the sphere of directions.
std::vector<Spectrum> Guide::gathered(const Medium& medium, const std::vector<double>& altitudes_m) const {
  constexpr int kZeniths = 12, kAzimuths = 5;
  std::vector<Spectrum> out(direct_.size(), Spectrum(0));
  Cells cells;
  for (int j = 0; j < kAltitudes; ++j) {
    for (int z = 0; z < kZeniths; ++z) {
      const double h = altitudeOf(j, top_m_), mu = -1 + (2 * z + 1.0) / kZeniths, sine = std::sqrt(1 - mu * mu);
      const ShellRay ray = rayFrom(medium, h, mu);
      const auto ground = distanceToGround(ray);
      cutRay(medium, altitudes_m, ray, ground ? *ground : distanceToTop(ray, top_m_), cells);
      struct Event {
        double altitude_m, distance_m, radius_m;
        Spectrum weight;
      };
      std::vector<Event> events;
      for (std::size_t c = 0; c < cells.count(); ++c) {
        const double t = 0.5 * (cells.edge_m[c] + cells.edge_m[c + 1]);
        const Spectrum all = cells.depth[c + 1] - cells.depth[c];
        Spectrum weight = cells.scattering[c];
        for (int k = 0; k < 3; ++k)
          if (all[k] > 0) weight[k] *= -std::expm1(-all[k]) / all[k];
        events.push_back({ray.altitudeAt(t), t, ray.radiusAt(t), weight * glm::exp(-cells.depth[c])});
      }
      for (int i = 0; i < kSuns; ++i) {
        const double muSun = sunOf(i), sunSine = std::sqrt(1 - muSun * muSun);
        Spectrum sum{};
        for (int a = 0; a < kAzimuths; ++a) {
          const double cosSun = mu * muSun + sine * sunSine * std::cos(kPi * (a + 0.5) / kAzimuths);
          const auto sunAt = [&](double t, double r) { return std::clamp((ray.startRadius_m() * muSun + t * cosSun) / r, -1.0, 1.0); };
          for (const Event& e : events) {
            const double s = sunAt(e.distance_m, e.radius_m);
            sum += e.weight * (direct(e.altitude_m, s) + ambient(e.altitude_m, s));
          }
          if (ground) sum += glm::exp(-cells.depth.back()) * medium.albedo * this->ground(sunAt(*ground, medium.radius_m));
        }
        out[std::size_t(j) * kSuns + i] += sum / double(kZeniths * kAzimuths);
      }
    }
  }
  return out;
}

}  // namespace welkin::reference
