#include "path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "welkin/reference/directions.h"

namespace welkin::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPlainShare = 0.15;  // of events drawn without the guide: bounds a weight by 7 where the guide is wrong
constexpr int kFirstRoulette = 3;     // the order from which paths may end early

double mean(const Spectrum& v) { return (v.x + v.y + v.z) / 3; }
double most(const Spectrum& v) { return std::max({v.x, v.y, v.z}); }

// Sums to probabilities of 1 by wavelength, running; 0 where there is nothing.
Spectrum total(const std::vector<Spectrum>& values) {
  Spectrum sum{};
  for (const Spectrum& v : values) sum += v;
  return sum;
}

Spectrum layerScattering(const Medium& medium, double altitude_m) {
  Spectrum sum{};
  for (const MediumLayer& layer : medium.layers) sum += layer.scattering * density(layer, altitude_m);
  return sum;
}

}  // namespace

PathDrawer::PathDrawer(const Medium& medium, const std::vector<double>& altitudes_m, const Guide& guide, const LitRay& ray,
                       const PathSettings& settings)
    : medium_(medium), altitudes_m_(altitudes_m), guide_(guide), settings_(settings), toSun_(ray.toSun) {
  first_.ray = ray.ray, first_.up = ray.up, first_.direction = ray.direction;
  first_.length_m = ray.length_m, first_.end = ray.end;
  fill(first_, settings.withFirstOrder);
}

Spectrum PathDrawer::expected(double altitude_m, double muSun, bool directCounts) const {
  if (settings_.light == Light::Everywhere) return Spectrum(1);
  const Spectrum ambient = guide_.ambient(altitude_m, muSun);
  return directCounts ? ambient + guide_.direct(altitude_m, muSun) : ambient;
}

Spectrum PathDrawer::expectedOfGround(double muSun, bool directCounts) const {
  if (settings_.light == Light::Everywhere) return medium_.albedo;
  return medium_.albedo * (directCounts ? guide_.ground(muSun) : guide_.ambient(0, muSun));
}

// Cells and their probabilities: the share of light that collides and is scattered there, times what a collision brings.
void PathDrawer::fill(PathSegment& s, bool directCounts) {
  cutRay(medium_, altitudes_m_, s.ray, s.length_m, s.cells);
  const std::size_t n = s.cells.count();
  const double sunMu = glm::dot(s.up, toSun_), cosSun = glm::dot(s.direction, toSun_);
  const auto muSunAt = [&](double t) { return std::clamp((s.ray.startRadius_m() * sunMu + t * cosSun) / s.ray.radiusAt(t), -1.0, 1.0); };
  plain_.resize(n + 1), guided_.resize(n + 1);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 0.5 * (s.cells.edge_m[i] + s.cells.edge_m[i + 1]);
    const Spectrum all = s.cells.depth[i + 1] - s.cells.depth[i];
    Spectrum weight = s.cells.scattering[i] * glm::exp(-s.cells.depth[i]);
    for (int k = 0; k < 3; ++k)
      if (all[k] > 0) weight[k] *= -std::expm1(-all[k]) / all[k];
    plain_[i] = weight;
    guided_[i] = weight * expected(s.ray.altitudeAt(t), muSunAt(t), directCounts);
  }
  plain_[n] = guided_[n] = Spectrum(0);
  if (s.end == RayEnd::Ground) {
    plain_[n] = glm::exp(-s.cells.depth.back()) * medium_.albedo;
    guided_[n] = glm::exp(-s.cells.depth.back()) * expectedOfGround(muSunAt(s.length_m), directCounts);
  }
  const Spectrum plain = total(plain_), guided = total(guided_);
  s.cumulative.resize(n + 1);
  Spectrum running{};
  for (std::size_t i = 0; i <= n; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (!(plain[k] > 0)) continue;
      const double p = plain_[i][k] / plain[k];
      running[k] += guided[k] > 0 ? kPlainShare * p + (1 - kPlainShare) * guided_[i][k] / guided[k] : p;
    }
    s.cumulative[i] = running;
  }
}

PathDrawer::Event PathDrawer::drawEvent(const PathSegment& s, int hero, PathNumbers& numbers) {
  const std::size_t n = s.cells.count();
  const double u = numbers.next() * s.cumulative[n][hero];
  const auto before = [&](std::size_t i) { return i > 0 ? s.cumulative[i - 1] : Spectrum(0); };
  std::size_t i = 0;
  while (i < n && s.cumulative[i][hero] <= u) ++i;
  // Rounding may put u on the last step: go back to something that can be drawn
  while (i > 0 && !(s.cumulative[i][hero] > before(i)[hero])) --i;
  const Spectrum probability = s.cumulative[i] - before(i);
  if (i == n) {
    carried_ *= glm::exp(-s.cells.depth[n]);
    densities_ *= probability;
    const double r = s.ray.startRadius_m();
    return {true, 0, glm::normalize(s.up * r + s.direction * s.length_m)};
  }
  // Within the cell by the transmittance, as if its density were even; a thin cell evenly.
  const double v = std::clamp((u - before(i)[hero]) / probability[hero], 0.0, 1.0);
  const Spectrum depth = s.cells.depth[i + 1] - s.cells.depth[i];
  const double width = s.cells.edge_m[i + 1] - s.cells.edge_m[i];
  const double x = depth[hero] > 0 ? std::clamp(-std::log1p(v * std::expm1(-depth[hero])) / depth[hero], 0.0, 1.0) : v;
  for (int k = 0; k < 3; ++k) {
    const double within = depth[k] > 0 ? depth[k] * std::exp(-x * depth[k]) / -std::expm1(-depth[k]) : 1;
    densities_[k] *= probability[k] * within / width;
  }
  const double t = s.cells.edge_m[i] + x * width;
  carried_ *= glm::exp(-s.cells.depth[i] - depthWithin(medium_, s.ray, s.cells.edge_m[i], t));
  return {false, s.ray.altitudeAt(t), glm::normalize(s.up * s.ray.startRadius_m() + s.direction * t)};
}

// Transmittance towards a point of the sun's disc; on the ground times its zenith cosine.
Spectrum PathDrawer::sunAt(const Event& event, PathNumbers& numbers) {
  glm::dvec3 towards = toSun_;
  if (medium_.sunRadius_rad > 0) {
    const double half = std::sin(medium_.sunRadius_rad / 2);
    towards = directionAbout(toSun_, 1 - 2 * half * half * numbers.plain(), numbers.plain());
  }
  const double mu = std::clamp(glm::dot(event.up, towards), -1.0, 1.0);
  if (event.ground && mu <= 0) return Spectrum(0);
  const Spectrum t = quickTransmittance(medium_, altitudes_m_, event.altitude_m, mu, scratch_);
  return event.ground ? t * mu : t;
}

// The next segment, in a direction drawn from the phase functions at the event, or from the ground by the cosine. False: the hero cannot
// go on.
bool PathDrawer::turn(const Event& event, int hero, PathNumbers& numbers) {
  glm::dvec3 direction;
  if (event.ground) {
    numbers.next();  // which layer: keeps the lattice's dimensions in their places
    const double cosine = std::sqrt(numbers.next());
    direction = directionAbout(event.up, cosine, numbers.next());
    carried_ *= medium_.albedo;  // albedo / pi * cosine over cosine / pi
  } else {
    const Spectrum all = layerScattering(medium_, event.altitude_m);
    if (!(all[hero] > 0)) return false;  // on the edge of a layer
    double pick = numbers.next() * all[hero];
    const MediumLayer* chosen = nullptr;
    for (const MediumLayer& layer : medium_.layers) {
      const double s = layer.scattering[hero] * density(layer, event.altitude_m);
      if (s > 0) chosen = &layer;
      if (s > 0 && pick < s) break;
      pick -= s;
    }
    const double c = samplePhase(chosen->phase, chosen->g, numbers);
    direction = directionAbout(next_.direction, c, numbers.next());
    const Spectrum towards = scatteringTowards(medium_, event.altitude_m, c);
    carried_ *= towards;
    for (int k = 0; k < 3; ++k) densities_[k] *= all[k] > 0 ? towards[k] / all[k] : 0;
  }
  next_.up = event.up, next_.direction = direction;
  double mu = std::clamp(glm::dot(event.up, direction), -1.0, 1.0);
  if (event.ground) mu = std::max(mu, 0.0);
  next_.ray = rayFrom(medium_, event.altitude_m, mu);
  const auto ground = distanceToGround(next_.ray);
  next_.length_m = ground ? *ground : distanceToTop(next_.ray, medium_.top_m);
  next_.end = ground ? RayEnd::Ground : RayEnd::Space;
  return true;
}

Spectrum PathDrawer::draw(int hero, PathNumbers& numbers) {
  carried_ = densities_ = Spectrum(1);
  Spectrum brought{};
  double reference = 0;
  const PathSegment* segment = &first_;
  next_.direction = first_.direction;
  for (int order = 1;; ++order) {
    const bool counts = order > 1 || settings_.withFirstOrder;
    if (settings_.light == Light::Everywhere && segment->end == RayEnd::Space)
      brought += carried_ * glm::exp(-segment->cells.depth.back()) / mean(densities_);
    if (settings_.maxOrders > 0 && order > settings_.maxOrders) break;
    if (!(segment->cumulative.back()[hero] > 0)) break;  // nothing to meet
    const Event event = drawEvent(*segment, hero, numbers);
    if (settings_.light == Light::Sun && counts) {
      const Spectrum sun = sunAt(event, numbers);
      if (sun != Spectrum(0)) {
        const Spectrum scattered =
            event.ground ? medium_.albedo / kPi : scatteringTowards(medium_, event.altitude_m, glm::dot(next_.direction, toSun_));
        brought += carried_ * scattered * sun / mean(densities_);
      }
    }
    if (settings_.light == Light::Sun && order == settings_.maxOrders) break;
    const double muSun = std::clamp(glm::dot(event.up, toSun_), -1.0, 1.0);
    const Spectrum worth =
        event.ground ? expectedOfGround(muSun, true) : layerScattering(medium_, event.altitude_m) * expected(event.altitude_m, muSun, true);
    const double expectedNow = most(carried_ * worth) / mean(densities_);
    if (order == 1) reference = expectedNow;
    if (order >= kFirstRoulette && expectedNow < reference) {
      const double survives = expectedNow / reference;
      if (!(numbers.plain() < survives)) break;
      carried_ /= survives;
    }
    if (!turn(event, hero, numbers)) break;
    const double scale = densities_[hero];
    if (!(scale > 0)) break;  // a direction whose density underflows brings nothing
    carried_ /= scale, densities_ /= scale;
    fill(next_, true);
    segment = &next_;
  }
  return brought;
}

}  // namespace welkin::reference
