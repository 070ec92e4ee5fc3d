#include "guide.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "welkin/reference/directions.h"

namespace welkin::reference {
namespace {

constexpr int kAltitudes = 16, kSuns = 56;
constexpr int kZeniths = 16, kAzimuths = 6, kPatches = kZeniths * kAzimuths;  // azimuths: of half the circle
constexpr double kPi = std::numbers::pi;

// The sun's zenith cosine over a row of the table, five times as dense at the horizon as on average; altitudes as squares.
double sunOf(int i) {
  const double v = 2.0 * i / (kSuns - 1) - 1;
  return v / (5 - 4 * std::abs(v));
}
double sunPlace(double mu) { return (0.5 + 2.5 * mu / (1 + 4 * std::abs(mu))) * (kSuns - 1); }
double altitudeOf(int j, double top_m) { return top_m * j * j / ((kAltitudes - 1.0) * (kAltitudes - 1.0)); }
double altitudePlace(double h, double top_m) { return std::sqrt(std::clamp(h / top_m, 0.0, 1.0)) * (kAltitudes - 1); }

// Patches of the sphere of directions: zenith cosines v |v| for even v, densest at the horizontal.
double zenithEdge(int z) {
  const double v = 2.0 * z / kZeniths - 1;
  return v * std::abs(v);
}
int zenithOf(double mu) { return std::clamp(int((std::copysign(std::sqrt(std::abs(mu)), mu) + 1) / 2 * kZeniths), 0, kZeniths - 1); }
double solidAngle(int z) { return (zenithEdge(z + 1) - zenithEdge(z)) * 2 * kPi / kAzimuths; }  // of both sides

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

const Spectrum* Guide::skyAt(double altitude_m, double muSun) const {
  const int i = std::clamp(int(sunPlace(muSun) + 0.5), 0, kSuns - 1),
            j = std::clamp(int(altitudePlace(altitude_m, top_m_) + 0.5), 0, kAltitudes - 1);
  return &sky_[(std::size_t(j) * kSuns + i) * kPatches];
}

Guide::Direction Guide::sampleDirection(double altitude_m, double muSun, int k, double u, double v) const {
  const Spectrum* sky = skyAt(altitude_m, muSun);
  int patch = int(std::partition_point(sky, sky + kPatches - 1, [&](const Spectrum& s) { return s[k] <= u; }) - sky);
  const double before = patch > 0 ? sky[patch - 1][k] : 0, share = sky[patch][k] - before;
  const double within = share > 0 ? std::clamp((u - before) / share, 0.0, 1.0) : 0.5;
  const int z = patch / kAzimuths, a = patch % kAzimuths;
  return {zenithEdge(z) + within * (zenithEdge(z + 1) - zenithEdge(z)), (a + v) * kPi / kAzimuths};
}

Spectrum Guide::directionDensity(double altitude_m, double muSun, Direction direction) const {
  const int z = zenithOf(direction.mu), patch = z * kAzimuths + std::clamp(int(direction.azimuth_rad / kPi * kAzimuths), 0, kAzimuths - 1);
  const Spectrum* sky = skyAt(altitude_m, muSun);
  return (sky[patch] - (patch > 0 ? sky[patch - 1] : Spectrum(0))) / solidAngle(z);
}

// What arrives at the table's points from collisions as the tables now have them: mean over the sphere of directions.
std::vector<Spectrum> Guide::gathered(const Medium& medium, const std::vector<double>& altitudes_m) {
  sky_.assign(direct_.size() * kPatches, Spectrum(0));
  std::vector<Spectrum> out(direct_.size(), Spectrum(0));
  Cells cells;
  for (int j = 0; j < kAltitudes; ++j) {
    for (int z = 0; z < kZeniths; ++z) {
      const double h = altitudeOf(j, top_m_), mu = 0.5 * (zenithEdge(z) + zenithEdge(z + 1)), sine = std::sqrt(1 - mu * mu);
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
        for (int a = 0; a < kAzimuths; ++a) {
          Spectrum sum{};
          const double cosSun = mu * muSun + sine * sunSine * std::cos(kPi * (a + 0.5) / kAzimuths);
          const auto sunAt = [&](double t, double r) { return std::clamp((ray.startRadius_m() * muSun + t * cosSun) / r, -1.0, 1.0); };
          for (const Event& e : events) {
            const double s = sunAt(e.distance_m, e.radius_m);
            sum += e.weight * (direct(e.altitude_m, s) + ambient(e.altitude_m, s));
          }
          if (ground) sum += glm::exp(-cells.depth.back()) * medium.albedo * this->ground(sunAt(*ground, medium.radius_m));
          const std::size_t place = std::size_t(j) * kSuns + i;
          out[place] += sum * (solidAngle(z) / (4 * kPi));
          sky_[place * kPatches + std::size_t(z * kAzimuths + a)] = sum * solidAngle(z);
        }
      }
    }
  }
  for (std::size_t place = 0; place < direct_.size(); ++place) {
    Spectrum* sky = &sky_[place * kPatches];
    Spectrum running{};
    for (int p = 0; p < kPatches; ++p) running += sky[p], sky[p] = running;
    for (int k = 0; k < 3; ++k)
      for (int p = 0; p < kPatches; ++p)  // nothing to be seen: evenly over the patches
        sky[p][k] = running[k] > 0 ? sky[p][k] / running[k] : (p + 1.0) / kPatches;
  }
  return out;
}

}  // namespace welkin::reference
