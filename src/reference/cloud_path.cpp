#include "cloud_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "welkin/reference/directions.h"

namespace welkin::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kFirstRoulette = 4;
constexpr double kFaint = 0.05;  // of a path, or of the light seen through cloud: from there on it lives by chance

double mean(const Spectrum& v) { return (v.x + v.y + v.z) / 3; }
double most(const Spectrum& v) { return std::max({v.x, v.y, v.z}); }

}  // namespace

CloudPath::CloudPath(const CloudPathTracer& tracer, const PathRay& ray, const PathSettings& settings)
    : t_(tracer),
      ray_(ray),
      settings_(settings),
      source_{tracer.detail_, ray.position_planet, ray.towardsSun, 1},
      walk_(tracer.source_, tracer.root_, source_, ray.position_planet, ray.direction),
      sunWalk_(tracer.source_, tracer.root_, source_, ray.position_planet, ray.towardsSun) {}

bool CloudPath::begin() {
  const double R = t_.air_.radius_m, top = t_.air_.top_m;
  position_ = ray_.position_planet, direction_ = ray_.direction;
  const double r = glm::length(position_);
  altitude_m_ = r - R, onGround_ = false;
  if (altitude_m_ < 0) position_ *= R / r, altitude_m_ = 0;  // below the ground: on it
  if (altitude_m_ <= top) return true;
  const Stretch shell = sphereStretch(glm::dot(position_, direction_), (altitude_m_ - top) * (r + R + top));
  if (shell.empty() || shell.near >= ray_.maxDistance_m) return false;
  position_ += direction_ * shell.near, altitude_m_ = top;
  return true;
}

CloudPath::Meets CloudPath::collide(double altitude_m, double cloud_per_m, double place, double majorant_per_m, int hero) {
  Meets met = Meets::Cloud;
  Spectrum drawn(cloud_per_m), scattered(cloud_per_m);
  if (place >= cloud_per_m) {
    met = Meets::Air;
    place -= cloud_per_m;
    for (const MediumLayer& layer : t_.air_.layers) {
      const double d = density(layer, altitude_m);
      if (!(layer.extinction[hero] * d > 0)) continue;
      layer_ = &layer, drawn = layer.extinction * d, scattered = layer.scattering * d;
      if (place < layer.extinction[hero] * d) break;
      place -= layer.extinction[hero] * d;
    }
  }
  const double own = drawn[hero] / majorant_per_m;
  carried_ *= scattered / majorant_per_m / own, densities_ *= drawn / majorant_per_m / own;
  return met;
}

CloudPath::Meets CloudPath::fly(int hero, PathNumbers& numbers, double limit_m) {
  const Medium& air = t_.air_;
  const glm::dvec3 up = glm::normalize(position_), start = position_;
  const ShellRay shell = rayFrom(air, altitude_m_, std::clamp(glm::dot(up, direction_), -1.0, 1.0));
  std::optional<double> ground = onGround_ ? std::nullopt : distanceToGround(shell);
  const double whole = ground ? *ground : distanceToTop(shell, air.top_m), length = std::min(whole, limit_m);
  splitAt(t_.altitudes_m_, shell, 0, length, edges_);
  walk_.restart(start, direction_);
  const auto arrive = [&](double t) { position_ = start + direction_ * t, altitude_m_ = shell.altitudeAt(t), onGround_ = false; };
  for (std::size_t i = 0; i + 1 < edges_.size(); ++i) {
    const double middle = shell.altitudeAt(0.5 * (edges_[i] + edges_[i + 1]));
    const auto above = std::upper_bound(t_.altitudes_m_.begin(), t_.altitudes_m_.end(), middle) - t_.altitudes_m_.begin();
    const auto& slab = t_.slabs_[std::size_t(std::clamp<std::ptrdiff_t>(above - 1, 0, std::ptrdiff_t(t_.slabs_.size()) - 1))];
    const double end = edges_[i + 1];
    for (double t = edges_[i]; t < end;) {
      const SourceWalk::Piece piece = slab.cloudy ? walk_.enterNode(t, end) : SourceWalk::Piece{end, true, 0};
      const double majorant = slab.greatest_per_m + (piece.empty ? 0 : piece.greatest_per_m);
      while (majorant > 0) {
        t -= std::log1p(-numbers.next()) / majorant;
        if (t >= piece.to) break;
        const double altitude = shell.altitudeAt(t), cloud = piece.empty ? 0 : walk_.density(t);
        const Spectrum all = extinction(air, altitude) + cloud;
        if (most(all) > majorant * (1 + 1e-6)) ++t_.aboveBounds_;
        const double place = numbers.next() * majorant;
        if (place < all[hero]) {
          const Meets met = collide(altitude, cloud, place, majorant, hero);
          arrive(t);
          return met;
        }
        const Spectrum passed = glm::max(Spectrum(majorant) - all, Spectrum(0));
        carried_ *= passed / passed[hero], densities_ *= passed / passed[hero];
      }
      t = piece.to;
    }
  }
  if (length < whole || !ground) return Meets::Space;
  arrive(length);
  position_ *= air.radius_m / glm::length(position_), altitude_m_ = 0, onGround_ = true;
  return Meets::Ground;
}

double CloudPath::cloudTransmittance(glm::dvec3 towards, PathNumbers& numbers) {
  CameraRay ray = reference::rayFrom(position_, towards, t_.air_.radius_m);
  ray.ground_m = -1;  // the ground is looked after with the air
  const Stretch s = shellStretch(ray, t_.base_m_, t_.top_m_);
  if (s.empty()) return 1;
  sunWalk_.restart(position_, towards);
  double left = 1;
  for (double t = s.near; t < s.far;) {
    const SourceWalk::Piece piece = sunWalk_.enterNode(t, s.far);
    while (!piece.empty) {
      t -= std::log1p(-numbers.plain()) / piece.greatest_per_m;
      if (t >= piece.to) break;
      left *= std::max(1 - sunWalk_.density(t) / piece.greatest_per_m, 0.0);
      if (left >= kFaint) continue;
      if (numbers.plain() * kFaint >= left) return 0;
      left = kFaint;
    }
    t = piece.to;
  }
  return left;
}

Spectrum CloudPath::sunAt(PathNumbers& numbers) {
  const Medium& air = t_.air_;
  toSun_ = ray_.towardsSun;
  if (air.sunRadius_rad > 0) {
    const double half = std::sin(air.sunRadius_rad / 2);
    toSun_ = directionAbout(toSun_, 1 - 2 * half * half * numbers.plain(), numbers.plain());
  }
  const double mu = std::clamp(glm::dot(glm::normalize(position_), toSun_), -1.0, 1.0);
  if (onGround_ && mu <= 0) return Spectrum(0);
  Spectrum seen = quickTransmittance(air, t_.cells_m_, altitude_m_, mu, scratch_);
  if (seen == Spectrum(0)) return seen;
  seen *= cloudTransmittance(toSun_, numbers);
  return onGround_ ? seen * mu : seen;
}

void CloudPath::turn(Meets met, PathNumbers& numbers) {
  if (met == Meets::Ground) {
    const double cosine = std::sqrt(numbers.next());
    direction_ = directionAbout(glm::normalize(position_), cosine, numbers.next());
    carried_ *= t_.air_.albedo;
    return;
  }
  double c;
  if (met == Meets::Cloud) {
    const Droplets& d = t_.droplets_;
    const double g = numbers.next() < d.forwardShare ? d.forwardG : d.backwardG;
    c = samplePhase(PhaseType::HenyeyGreenstein, g, numbers);
  } else {
    c = samplePhase(layer_->phase, layer_->g, numbers);
  }
  direction_ = directionAbout(direction_, c, numbers.next());
}

Spectrum CloudPath::draw(int hero, PathNumbers& numbers) {
  carried_ = densities_ = Spectrum(1);
  Spectrum brought{};
  const bool everywhere = settings_.light == Light::Everywhere;
  if (!begin()) return everywhere ? Spectrum(1) : brought;
  for (int order = 1;; ++order) {
    const double limit_m =
        order > 1 ? std::numeric_limits<double>::infinity() : ray_.maxDistance_m - glm::length(position_ - ray_.position_planet);
    const Meets met = fly(hero, numbers, limit_m);
    if (met == Meets::Space) {
      if (everywhere && (order > 1 || std::isinf(limit_m))) brought += carried_ / mean(densities_);
      break;
    }
    if (settings_.maxOrders > 0 && order > settings_.maxOrders) break;
    if (!everywhere) {
      const Spectrum sun = sunAt(numbers);
      if (sun != Spectrum(0)) {
        const double c = glm::dot(direction_, toSun_);
        const Spectrum scattered = met == Meets::Ground  ? t_.air_.albedo / kPi
                                   : met == Meets::Cloud ? Spectrum(phase(t_.droplets_, c))
                                                         : Spectrum(phase(layer_->phase, layer_->g, c));
        brought += carried_ * scattered * sun / mean(densities_);
      }
      if (order == settings_.maxOrders) break;
    }
    turn(met, numbers);
    const double weight = most(carried_) / mean(densities_);
    if (!(weight > 0)) break;
    if (order < kFirstRoulette || weight >= 0.5) continue;
    const double survive = std::max(weight, kFaint);
    if (numbers.plain() >= survive) break;
    carried_ /= survive;
  }
  return brought;
}

}  // namespace welkin::reference
