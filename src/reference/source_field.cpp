#include "welkin/reference/source_field.h"

#include <array>
#include <optional>

#include "welkin/reference/hash.h"

namespace welkin::reference {
namespace {

constexpr double kPastFace_steps = 1e-3;
constexpr double kThinNode = 4;      // measured on two rays of pose near: 2 to 8 make no difference to the time, 32 is a quarter slower
constexpr double kLeakVoxels = 2.5;  // how far beyond its altitudes a source is seen: band limits, and as far as bricks carry it

// The light of a piece is the parabola through its ends and its middle: cloud is band-limited to the voxel, and a piece is one long.
class SourceAlong final : public CloudAlong {
 public:
  SourceAlong(const SourceField& field, SourceWalk walk, glm::dvec3 start, glm::dvec3 direction)
      : field_(field), walk_(std::move(walk)), start_(start), direction_(direction) {}

  double enter(double t, double end) override {
    const SourceWalk::Piece piece = walk_.enter(t, end, 1);
    from_ = t, to_ = piece.to, empty_ = piece.empty, lit_ = false;
    return piece.to;
  }
  bool empty() const override { return empty_; }
  CloudSample at(double t) const override {
    const double density = walk_.density(t);
    if (density <= 0) return {};
    if (!lit_) {
      for (std::size_t i = 0; i < 3; ++i) {
        const double at = from_ + 0.5 * double(i) * (to_ - from_);
        light_[i] = i == 0 && at == lastAt_ ? last_ : lightAt(start_ + direction_ * at);
      }
      lastAt_ = to_, last_ = light_[2], lit_ = true;
    }
    const double x = (t - from_) / (to_ - from_);
    const glm::dvec3 light = light_[0] * ((1 - x) * (1 - 2 * x)) + light_[1] * (4 * x * (1 - x)) + light_[2] * (x * (2 * x - 1));
    const glm::dvec3 encoded = glm::clamp(light, 0.0, 1.0);
    return {density, encoded.x, encoded.y, encoded.z};
  }

 private:
  // Encoded depths: towards the sun, chords.
  glm::dvec3 lightAt(glm::dvec3 at) const {
    const double sun = field_.sunDepth(at);
    const glm::dvec2 chords = field_.chords(at, sun);
    return {encodeDepth(sun), encodeDepth(chords.x), encodeDepth(chords.y)};
  }

  const SourceField& field_;
  SourceWalk walk_;
  glm::dvec3 start_, direction_;
  double from_ = 0, to_ = 0;
  bool empty_ = true;
  mutable bool lit_ = false;
  mutable double lastAt_ = -1;
  mutable glm::dvec3 last_{};
  mutable std::array<glm::dvec3, 3> light_{};
};

}  // namespace

SourceWalk::SourceWalk(const DensitySource& source, const RootFrame& root, const SourceSettings& settings, glm::dvec3 start_planet,
                       glm::dvec3 direction)
    : source_(source), root_(root), settings_(settings) {
  restart(start_planet, direction);
}

// A direction that drifts across the whole root by less than a step past a face is parallel to the face: else a ray within it would crawl
// along.
void SourceWalk::restart(glm::dvec3 start_planet, glm::dvec3 direction) {
  start_ = start_planet, direction_ = direction;
  for (int a = 0; a < 3; ++a)
    if (std::abs(direction[a]) < kPastFace_steps * 0x1p-32) direction_[a] = 0;
}

Bounds SourceWalk::boundsAt(glm::uvec3 p, std::uint32_t level) {
  const glm::uvec3 corner = shared::nodeCorner(p, level);
  auto& known = known_[level];
  if (!known || known->corner != corner) known = {corner, source_.bounds(corner, level)};
  return known->bounds;
}

SourceWalk::Piece SourceWalk::enter(double t, double end, double voxels) { return piece(t, end, voxels, 0); }
SourceWalk::Piece SourceWalk::enterNode(double t, double end) { return piece(t, end, std::numeric_limits<double>::infinity(), kThinNode); }

// Nodes are halved down to the level of detail, or until their optical depth is below `thin`.
SourceWalk::Piece SourceWalk::piece(double t, double end, double voxels, double thin) {
  const double past_m = kPastFace_steps * root_.step_m(), inside = t + past_m;
  const glm::dvec3 at = start_ + direction_ * inside;
  const Stretch cube = cubeStretch(start_, direction_, glm::dvec3(-root_.half_m), 2 * root_.half_m);
  if (inside < cube.near || inside >= cube.far)  // beyond the root there is nothing
    return {std::min(end, !cube.empty() && inside < cube.near ? cube.near : end), true, 0};
  const glm::uvec3 p = root_.toFixed(at);
  const double away = glm::length(at - settings_.eye_planet);
  const std::uint32_t want = settings_.detail.level(away);
  const bool fades = settings_.detail.parentWeight(want, away) > 0;
  // Bounds hold for a node's own level and all deeper ones: the parent's density is within the parent's bounds.
  const std::uint32_t deepest = fades ? want - 1 : want;
  Bounds bounds;
  std::uint32_t level = 0;
  while (true) {
    bounds = boundsAt(p, level);
    if (bounds.empty() || level == deepest || double(bounds.hi) * root_.nodeSize_m(level) < thin) break;
    ++level;
  }
  const double size_m = root_.nodeSize_m(level);
  double to = cubeStretch(start_, direction_, root_.toPlanet(shared::nodeCorner(p, level)), size_m).far;
  if (!bounds.empty()) to = std::min(to, t + voxels * root_.nodeSize_m(want) / 7);
  // The distance from the eye at which the rule breaks, as a distance along the ray: exact for a ray from the eye, near for others.
  const double next = settings_.detail.nextBreak(want, away) - away;
  to = std::min(to, inside + std::max(next, past_m));
  return {std::min(end, std::max(to, t + past_m)), bounds.empty(), double(bounds.hi)};
}

double SourceWalk::density(double t) const {
  const glm::dvec3 at = start_ + direction_ * t;
  const glm::uvec3 p = root_.toFixed(at);
  const double away = glm::length(at - settings_.eye_planet);
  const std::uint32_t level = settings_.detail.level(away);
  const double weight = settings_.detail.parentWeight(level, away);
  double sum = weight < 1 ? (1 - weight) * double(source_.density(p, level)) : 0;
  if (weight > 0) sum += weight * double(source_.density(p, level - 1));
  return sum;
}

SourceField::SourceField(const DensitySource& source, const RootFrame& root, const SourceSettings& settings)
    : source_(source), root_(root), settings_(settings) {}

Stretch SourceField::stretchOf(const CameraRay& ray) const {
  const double base = source_.base_m(), top = source_.top_m();
  const Stretch bare = shellStretch(ray, base, top);
  if (bare.empty()) return bare;
  const double leak = kLeakVoxels / 7 * root_.nodeSize_m(settings_.detail.level(bare.far));
  return shellStretch(ray, base - leak, top + leak * (1 - limbShare(ray)));
}

std::unique_ptr<CloudAlong> SourceField::along(const CameraRay& ray, double from_m) const {
  const glm::dvec3 start = ray.position_planet + ray.direction * from_m;
  return std::make_unique<SourceAlong>(*this, SourceWalk(source_, root_, settings_, start, ray.direction), start, ray.direction);
}

// What the GPU is given of a source is all of it.
std::uint64_t SourceField::contentHash() const {
  Hash hash;
  hash.add(source_.shader());
  const auto words = source_.shaderParams();
  hash.add(words.data(), words.size() * sizeof(words[0]));
  if (const CoverFaces* cover = source_.cover()) hash.add(cover->texels.data(), cover->texels.size() * sizeof(cover->texels[0]));
  const SourceSettings& s = settings_;
  for (const double v : {root_.planetRadius_m, root_.half_m, s.detail.reach_m, double(s.detail.depth), s.detail.near_m, s.eye_planet.x,
                         s.eye_planet.y, s.eye_planet.z, s.towardsSun.x, s.towardsSun.y, s.towardsSun.z, s.shadowVoxels})
    hash.add(v);
  return hash.value();
}

double SourceField::sunDepth(glm::dvec3 position_planet) const {
  const CameraRay ray = reference::rayFrom(position_planet, settings_.towardsSun, root_.planetRadius_m);
  if (ray.ground_m >= 0) return kOpaqueDepth;
  const double leak = kLeakVoxels / 7 * root_.nodeSize_m(settings_.detail.level(glm::length(position_planet - settings_.eye_planet)));
  const Stretch s = shellStretch(ray, -2 * root_.planetRadius_m, source_.top_m() + leak);
  if (s.empty()) return 0;
  SourceWalk walk(source_, root_, settings_, position_planet, settings_.towardsSun);
  return std::min(depthWithin(walk, s, kOpaqueDepth), kOpaqueDepth);
}

double SourceField::halfChord(glm::dvec3 position_planet, glm::dvec3 direction) const {
  const CameraRay ray = reference::rayFrom(position_planet, direction, root_.planetRadius_m);
  const double node_m = root_.nodeSize_m(settings_.detail.level(glm::length(position_planet - settings_.eye_planet)));
  Stretch s = shellStretch(ray, -2 * root_.planetRadius_m, source_.top_m() + kLeakVoxels / 7 * node_m);
  s.far = std::min(s.far, kChordReach_m + node_m);
  if (s.empty()) return 0;
  SourceWalk walk(source_, root_, settings_, position_planet, direction);
  return std::min(depthWithin(walk, s, kOpaqueDepth), kOpaqueDepth);
}

glm::dvec2 SourceField::chords(glm::dvec3 position_planet, double sunDepth) const {
  const glm::dvec3 up = glm::normalize(position_planet);
  return {sunDepth + halfChord(position_planet, -settings_.towardsSun), halfChord(position_planet, up) + halfChord(position_planet, -up)};
}

double SourceField::opticalDepth(const CameraRay& ray, double most_m) const {
  Stretch s = stretchOf(ray);
  s.far = std::min(s.far, most_m);
  if (s.empty()) return 0;
  SourceWalk walk(source_, root_, settings_, ray.position_planet, ray.direction);
  return depthWithin(walk, s, std::numeric_limits<double>::infinity());
}

double SourceField::depthWithin(SourceWalk& walk, Stretch s, double most) const {
  double depth = 0;
  for (double t = s.near; t < s.far && depth < most;) {
    const SourceWalk::Piece piece = walk.enter(t, s.far, settings_.shadowVoxels);
    if (!piece.empty) {
      const double middle = 0.5 * (t + piece.to), half = 0.5 * (piece.to - t), off = half / std::sqrt(3.0);
      depth += half * (walk.density(middle - off) + walk.density(middle + off));
    }
    t = piece.to;
  }
  return depth;
}

}  // namespace welkin::reference
