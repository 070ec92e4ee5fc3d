#include "path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "welkin/reference/directions.h"

namespace welkin::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPlainShare = 0.25;  // of events drawn without the guide: bounds a weight by 4 where the guide is wrong
constexpr double kGuidedShare = 0.5;  // of directions
constexpr int kGuidedEvents = 5;      // later ones are drawn without it: its factors would spread the weights of long paths
constexpr int kFirstRoulette = 3;     // the event from which paths may end early

double mean(const Spectrum& v) { return (v.x + v.y + v.z) / 3; }
double most(const Spectrum& v) { return std::max({v.x, v.y, v.z}); }

// Sums to probabilities of 1 by wavelength, running; 0 where there is nothing.
Spectrum total(const std::vector<Spectrum>& values) {
  Spectrum sum{};
  for (const Spectrum& v : values) sum += v;
  return sum;
}

// Distance in a cell at which the optical depth from its start has a value, at one wavelength: Newton's method, kept in a bracket.
double distanceAtDepth(const Medium& medium, const ShellRay& ray, double from, double to, int k, double depth) {
  double low = from, high = to, t = from + (to - from) * std::min(depth / depthWithin(medium, ray, from, to)[k], 1.0);
  for (int i = 0; i < 40; ++i) {
    const double off = depthWithin(medium, ray, from, t)[k] - depth, slope = extinction(medium, ray.altitudeAt(t))[k];
    (off > 0 ? high : low) = t;
    // An error e of the optical depth weights the path by exp(e): 1e-9 is nothing
    if (std::abs(off) <= 1e-9 * (1 + depth)) break;
    const double next = t - off / slope;
    t = next > low && next < high ? next : 0.5 * (low + high);
  }
  return t;
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
  fill(first_, settings.withFirstOrder, true);
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
void PathDrawer::fill(PathSegment& s, bool directCounts, bool guided) {
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
    guided_[i] = !guided ? weight : weight * expected(s.ray.altitudeAt(t), muSunAt(t), directCounts);
  }
  plain_[n] = guided_[n] = Spectrum(0);
  if (s.end == RayEnd::Ground) {
    plain_[n] = glm::exp(-s.cells.depth.back()) * medium_.albedo;
    guided_[n] = !guided ? plain_[n] : glm::exp(-s.cells.depth.back()) * expectedOfGround(muSunAt(s.length_m), directCounts);
  }
  const Spectrum plain = total(plain_), best = total(guided_);
  s.cumulative.resize(n + 1);
  Spectrum running{};
  for (std::size_t i = 0; i <= n; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (!(plain[k] > 0)) continue;
      const double p = plain_[i][k] / plain[k];
      running[k] += best[k] > 0 ? kPlainShare * p + (1 - kPlainShare) * guided_[i][k] / best[k] : p;
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
  const double from = s.cells.edge_m[i], to = s.cells.edge_m[i + 1];
  const Spectrum depth = s.cells.depth[i + 1] - s.cells.depth[i];
  const double v = std::clamp((u - before(i)[hero]) / probability[hero], 0.0, 1.0);
  const double t =
      depth[hero] > 0 ? distanceAtDepth(medium_, s.ray, from, to, hero, -std::log1p(v * std::expm1(-depth[hero]))) : from + v * (to - from);
  const Spectrum reached = depthWithin(medium_, s.ray, from, t), here = extinction(medium_, s.ray.altitudeAt(t));
  for (int k = 0; k < 3; ++k)
    densities_[k] *= probability[k] * (depth[k] > 0 ? here[k] * std::exp(-reached[k]) / -std::expm1(-depth[k]) : 1 / (to - from));
  carried_ *= glm::exp(-s.cells.depth[i] - reached);
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

// The next segment, in a direction drawn from the phase functions at the event (from the ground: by the cosine) or, if guided, half of the
// time from the guide. False: the path brings nothing more.
bool PathDrawer::turn(const Event& event, int hero, bool guided, PathNumbers& numbers) {
  const Spectrum all = event.ground ? medium_.albedo : layerScattering(medium_, event.altitude_m);
  if (!(all[hero] > 0)) return false;  // on the edge of a layer
  const double muSun = std::clamp(glm::dot(event.up, toSun_), -1.0, 1.0), share = guided ? kGuidedShare : 0;
  const glm::dvec3 level = toSun_ - event.up * muSun;
  // With the sun overhead the guide knows no azimuths: any will do
  const glm::dvec3 side = glm::dot(level, level) > 0 ? glm::normalize(level) : directionAbout(event.up, 0, 0);
  const glm::dvec3 other = glm::cross(event.up, side);
  const double how = numbers.next();
  glm::dvec3 direction;
  if (how < share) {
    const auto [mu, azimuth] = guide_.sampleDirection(event.altitude_m, muSun, hero, numbers.next(), numbers.next());
    const double turned = numbers.plain() < 0.5 ? azimuth : -azimuth, sine = std::sqrt(std::max(1 - mu * mu, 0.0));
    direction = glm::normalize(event.up * mu + (side * std::cos(turned) + other * std::sin(turned)) * sine);
  } else if (event.ground) {
    const double cosine = std::sqrt(numbers.next());
    direction = directionAbout(event.up, cosine, numbers.next());
  } else {
    double pick = (how - share) / (1 - share) * all[hero];
    const MediumLayer* chosen = nullptr;
    for (const MediumLayer& layer : medium_.layers) {
      const double s = layer.scattering[hero] * density(layer, event.altitude_m);
      if (s > 0) chosen = &layer;
      if (s > 0 && pick < s) break;
      pick -= s;
    }
    const double c = samplePhase(chosen->phase, chosen->g, numbers);
    direction = directionAbout(next_.direction, c, numbers.next());
  }
  const double mu = std::clamp(glm::dot(event.up, direction), -1.0, 1.0);
  if (event.ground && mu <= 0) return false;
  const Spectrum towards =
      event.ground ? medium_.albedo * (mu / kPi) : scatteringTowards(medium_, event.altitude_m, glm::dot(next_.direction, direction));
  carried_ *= towards;
  Spectrum guide{};
  if (share > 0) {
    const double azimuth = std::atan2(std::abs(glm::dot(direction, other)), glm::dot(direction, side));
    guide = guide_.directionDensity(event.altitude_m, muSun, {mu, azimuth});
  }
  for (int k = 0; k < 3; ++k) densities_[k] *= all[k] > 0 ? (1 - share) * towards[k] / all[k] + share * guide[k] : 0;
  next_.up = event.up, next_.direction = direction;
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
    const double weight = most(carried_ * (event.ground ? medium_.albedo : layerScattering(medium_, event.altitude_m))) / mean(densities_);
    if (order < kFirstRoulette) {
      reference = weight;
    } else if (weight < reference) {
      const double survives = weight / reference;
      if (!(numbers.plain() < survives)) break;
      carried_ /= survives;
    }
    if (!turn(event, hero, settings_.light == Light::Sun && order < kGuidedEvents, numbers)) break;
    const double scale = densities_[hero];
    if (!(scale > 0)) break;  // a direction whose density underflows brings nothing
    carried_ /= scale, densities_ /= scale;
    fill(next_, true, order < kGuidedEvents);
    segment = &next_;
  }
  return brought;
}

}  // namespace welkin::reference
