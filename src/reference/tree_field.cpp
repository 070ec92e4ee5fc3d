#include "welkin/reference/tree_field.h"

#include <array>

#include "welkin/reference/hash.h"

namespace welkin::reference {
namespace {

constexpr double kStepsOfRoot = 0x1p32;
constexpr double kPastFace_steps = 1e-3;  // how far behind a face the next cell is looked for: 3 micrometres for an Earth

// The two values of a cell's eight corners, and where the cell is in its brick.
struct Cell {
  glm::dvec3 corner{};  // of the cell, in cells of the brick
  std::array<glm::dvec2, 8> value{};
  bool empty = true;  // no density at any corner

  glm::dvec2 at(glm::dvec3 local) const {
    const glm::dvec3 f = local - corner;
    const auto x = [&](std::size_t i) { return value[i] + (value[i + 1] - value[i]) * f.x; };
    const glm::dvec2 near = x(0) + (x(2) - x(0)) * f.y, far = x(4) + (x(6) - x(4)) * f.y;
    return near + (far - near) * f.z;
  }
};

class TreeAlong final : public CloudAlong {
 public:
  TreeAlong(const TreeField& field, const CameraRay& ray, double from_m) : field_(field), from_m_(from_m) {
    const shared::TreeBlock& block = field.data().block;
    start_ = (ray.position_planet + ray.direction * from_m + block.half_m) * block.stepsPerMetre;
    slope_ = ray.direction * block.stepsPerMetre;
    root_ = cubeStretch(start_, slope_, glm::dvec3(0), kStepsOfRoot);
    past_m_ = kPastFace_steps / block.stepsPerMetre;
    density_per_m_ = double(block.maxExtinction_per_m);
  }

  double enter(double t, double end) override {
    const double inside = t + past_m_, away = from_m_ + inside;
    const glm::dvec3 s = start_ + slope_ * inside;
    // Beyond the root's faces there is nothing; coarse voxels make the band of cloud reach out there.
    if (inside < root_.near || inside >= root_.far) {
      empty_ = true;
      return past(t, end, !root_.empty() && inside < root_.near ? root_.near : end);
    }
    const DetailRule& detail = field_.detail();
    const bool smooth = field_.fade() == Fade::Smooth;
    // In the node that was visited last nothing needs to be looked up, unless its level ends or begins to fade.
    const std::uint32_t wanted = detail.level(away);
    const double weight = detail.parentWeight(wanted, away);
    const bool known = glm::all(glm::greaterThanEqual(s, corner_)) && glm::all(glm::lessThan(s, corner_ + size_));
    if (!known || (smooth && (wanted != want_ || (weight > 0) != asked_)))
      visit(glm::uvec3(glm::clamp(s, 0.0, kStepsOfRoot - 1)), wanted, weight);
    const double limit = smooth ? std::min(end, detail.nextBreak(wanted, away) - from_m_) : end;
    empty_ = nodeEmpty_;
    if (empty_) return past(t, limit, cubeStretch(start_, slope_, corner_, size_).far);
    const glm::dvec3 here = glm::clamp(glm::floor(cells_ + cellsPerMetre_ * inside), 0.0, 6.0);
    own_ = load(brick_, here);
    if (faded_) parent_ = load(parentBrick_, glm::clamp(glm::floor(0.5 * (here + 0.5) + half_), 0.0, 6.0));
    empty_ = own_.empty && (!faded_ || parent_.empty);
    return past(t, limit, cubeStretch(cells_, cellsPerMetre_, here, 1).far);
  }

  bool empty() const override { return empty_; }

  CloudSample at(double t) const override {
    const glm::dvec3 local = glm::clamp(cells_ + cellsPerMetre_ * t, 0.0, 7.0);
    glm::dvec4 own{own_.at(local), field_.chords(brick_, local)};
    if (faded_) {
      const double weight = field_.fade() == Fade::Smooth ? field_.detail().parentWeight(want_, from_m_ + t) : weight_;
      const glm::dvec3 inParent = glm::clamp(0.5 * local + half_, 0.0, 7.0);
      const glm::dvec4 parent{parent_.at(inParent), field_.chords(parentBrick_, inParent)};
      // light belongs to the density it was stored with
      const double a = own.x * (1 - weight), b = parent.x * weight;
      if (a + b > 0) own += (parent - own) * (b / (a + b));
      own.x = a + b;
    }
    const double density = std::max(own.x, 0.0) * density_per_m_, least = encodeDepth(ownChord(density, cell_m_));
    return {density, own.y, std::max(own.z, least), std::max(own.w, least)};
  }

 private:
  void visit(glm::uvec3 p, std::uint32_t want, double weight) {
    const TreeField::Node node = field_.lookUp(p, want);
    want_ = want, weight_ = weight, asked_ = weight > 0;
    faded_ = asked_ && node.level == want;  // what is coarser than was wanted does not fade
    const TreeField::Node above = faded_ ? field_.lookUp(p, want - 1) : node;
    nodeEmpty_ = above.empty;
    const std::uint32_t level = nodeEmpty_ ? above.level : node.level;
    corner_ = glm::dvec3(shared::nodeCorner(p, level)), size_ = std::ldexp(kStepsOfRoot, -int(level));
    cell_m_ = size_ / (7 * field_.data().block.stepsPerMetre);
    cells_ = (start_ - corner_) * (7 / size_), cellsPerMetre_ = slope_ * (7 / size_);
    brick_ = node.brick, parentBrick_ = above.brick;
    if (!faded_) return;
    // inside the parent: half the cells, from 0 or 3.5
    const std::uint32_t octant = shared::childOctant(p, want - 1);
    half_ = 3.5 * glm::dvec3(octant & 1u, (octant >> 1) & 1u, octant >> 2);
  }
  // Faces may be behind by rounding, or where a clamped position is: always on.
  double past(double t, double limit, double exit) const { return std::min(limit > t ? limit : t + past_m_, std::max(exit, t + past_m_)); }

  Cell load(std::uint32_t brick, glm::dvec3 corner) const {
    Cell cell;
    cell.corner = corner;
    const glm::uvec3 c(corner);
    for (std::uint32_t i = 0; i < 8; ++i) {
      cell.value[i] = field_.texel(brick, c + glm::uvec3(i & 1u, (i >> 1) & 1u, i >> 2));
      cell.empty = cell.empty && cell.value[i].x == 0;
    }
    return cell;
  }

  const TreeField& field_;
  double from_m_, past_m_, density_per_m_;
  Stretch root_;              // the ray within the root cube
  glm::dvec3 start_, slope_;  // of the ray, in fixed-point steps
  // the node that is visited: which level was wanted, its cube in steps, the ray in cells of its brick, the parent's part
  std::uint32_t want_ = 0, brick_ = 0, parentBrick_ = 0;
  double size_ = 0, cell_m_ = 0, weight_ = 0;
  bool asked_ = false, faded_ = false, nodeEmpty_ = true, empty_ = true;
  glm::dvec3 corner_{}, cells_{}, cellsPerMetre_{}, half_{};
  Cell own_, parent_;
};

}  // namespace

TreeField::TreeField(const TreeData& data, Fade fade)
    : data_(data),
      fade_(fade),
      detail_{double(data.block.detail) * double(data.block.rootSize_m), data.block.depth, double(data.block.sampleNear_m)} {}

std::unique_ptr<CloudAlong> TreeField::along(const CameraRay& ray, double from_m) const {
  return std::make_unique<TreeAlong>(*this, ray, from_m);
}

TreeField::Node TreeField::lookUp(glm::uvec3 p, std::uint32_t level) const {
  shared::NodeWords words = data_.nodes[0];
  std::uint32_t at = 0;
  while (at < level && words.group != shared::kNoGroup && !shared::wordEmpty(words.word))
    words = data_.nodes[words.group + shared::childOctant(p, at++)];
  const std::uint32_t code = shared::wordMaxCode(words.word);
  return {shared::wordBrick(words.word), at, code == 0, double(shared::maxCodeValue(code))};
}

glm::dvec2 TreeField::texel(std::uint32_t brick, glm::uvec3 i) const {
  const std::uint32_t texture = brick / data_.block.bricksPerTexture;
  const glm::uvec3 at = shared::brickTexel(brick - texture * data_.block.bricksPerTexture) + i;
  const std::size_t index = at.x + std::size_t{shared::kAtlasX * 8} * (at.y + std::size_t{shared::kAtlasY * 8} * at.z);
  const std::uint16_t* texel = data_.bricks[texture].data() + 2 * index;
  return {texel[0] / 65535.0, texel[1] / 65535.0};
}

glm::dvec2 TreeField::chords(std::uint32_t brick, glm::dvec3 cells) const {
  const auto& corners = data_.chords[brick];
  const glm::dvec3 f = cells / 7.0;
  const auto x = [&](std::size_t i) { return glm::mix(glm::dvec2(corners[i]), glm::dvec2(corners[i + 1]), f.x); };
  return glm::mix(glm::mix(x(0), x(2), f.y), glm::mix(x(4), x(6), f.y), f.z) / 65535.0;
}

Stretch TreeField::stretchOf(const CameraRay& ray) const {
  const shared::TreeBlock& block = data_.block;
  const double top = double(block.bandTop_m), limb = limbShare(ray);
  return shellStretch(ray, double(block.bandBase_m), top + limb * (std::min(top, double(block.cloudTop_m)) - top));
}

std::uint64_t TreeField::contentHash() const {
  Hash hash;
  hash.add(reference::contentHash(data_));
  hash.add(std::uint64_t(fade_));
  return hash.value();
}

std::uint64_t contentHash(const TreeData& data) {
  Hash hash;
  const shared::TreeBlock& b = data.block;
  for (const double v : {b.half_m, b.stepsPerMetre, double(b.sunDir.x), double(b.sunDir.y), double(b.sunDir.z), double(b.detail),
                         double(b.maxExtinction_per_m), double(b.bandBase_m), double(b.bandTop_m), double(b.planetRadius_m),
                         double(b.cloudTop_m), double(b.sampleNear_m), double(b.rootSize_m), double(b.depth)})
    hash.add(v);
  // Nodes in the order of the tree, bricks where their nodes are: numbers of nodes and bricks are left out.
  const TreeField field(data);
  const auto visit = [&](const auto& self, const shared::NodeWords& words) -> void {
    const std::uint32_t brick = shared::wordBrick(words.word);
    const bool open = words.group != shared::kNoGroup;
    hash.add(std::uint64_t{shared::wordMaxCode(words.word)} | std::uint64_t{open} << 8 | std::uint64_t{brick != shared::kZeroBrick} << 9);
    if (brick != shared::kZeroBrick) {
      const std::uint32_t texture = brick / b.bricksPerTexture;
      const glm::uvec3 at = shared::brickTexel(brick - texture * b.bricksPerTexture);
      for (std::uint32_t z = 0; z < 8; ++z)
        for (std::uint32_t y = 0; y < 8; ++y) {
          const std::size_t row = at.x + std::size_t{shared::kAtlasX * 8} * (at.y + y + std::size_t{shared::kAtlasY * 8} * (at.z + z));
          hash.add(data.bricks[texture].data() + 2 * row, 8 * 2 * sizeof(std::uint16_t));
        }
      hash.add(data.chords[brick].data(), sizeof(data.chords[brick]));
    }
    if (open)
      for (std::uint32_t i = 0; i < 8; ++i) self(self, data.nodes[words.group + i]);
  };
  if (!data.nodes.empty()) visit(visit, data.nodes[0]);
  return hash.value();
}

}  // namespace welkin::reference
