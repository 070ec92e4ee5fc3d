#include "relight.h"

#include <algorithm>
#include <glm/gtc/type_precision.hpp>
#include <optional>
#include <utility>

namespace welkin {
namespace {

constexpr std::uint64_t kLater = 6;        // steps
constexpr std::uint32_t kLookedAt = 8192;  // bricks a step: some tens of microseconds
constexpr double kStale_rad = 0.00465;     // the radius of the sun's disc, seen from the Earth

// The node of this address, if rays see it.
std::optional<NodeIndex> find(const Tree& tree, const glm::uvec3& corner, std::uint32_t level) {
  NodeIndex node = kRootNode;
  for (std::uint32_t l = 0; l < level; ++l) {
    const GroupIndex children = tree.node(node).children;
    if (!children.valid() || !tree.group(children).reachable) return {};
    const glm::uvec3 bit = (corner >> (31u - l)) & 1u;
    node = nodeOf(children, bit.x | (bit.y << 1u) | (bit.z << 2u));
  }
  return node;
}

bool isLit(const Tree& tree, NodeIndex node) {
  return tree.isLive(groupOf(node)) && tree.group(groupOf(node)).reachable && !tree.node(node).brick.isZero() && !tree.node(node).pending;
}

}  // namespace

Relight::Relight(std::uint32_t brickCapacity) : bricks_(brickCapacity) {}

void Relight::sun(glm::dvec3 toSun, std::uint64_t step) {
  const bool rests = begun_ && toSun == toSun_;
  if (!std::exchange(begun_, true)) litFor_ = toSun;
  toSun_ = toSun;
  away_ = -glm::sign(toSun);
  // Of small angles the chord is the angle, and does not cancel as the cosine would.
  if (glm::length(toSun - litFor_) > (rests ? 0 : kStale_rad))
    litFor_ = toSun, since_ = step, unswept_ = sunLeft_ = std::uint32_t(bricks_.size());
}

void Relight::lit(const Tree& tree, std::span<const NodeIndex> nodes, std::uint64_t step, bool soon) {
  if (nodes.empty() || away_ == glm::ivec3(0)) return;
  for (const NodeIndex node : nodes) {
    Brick& b = bricks_[tree.node(node).brick.value];
    b.lit = step, b.sun = toSun_;
  }
  if (soon)
    for (const NodeIndex node : nodes) behind(tree, node, step);
  unswept_ = std::uint32_t(bricks_.size());
  since_ = step;
}

void Relight::light(const Tree& tree, NodeIndex node, std::uint64_t step, std::vector<BrickJob>& light) {
  const NodeAddress at = tree.address(node);
  const BrickIndex brick = tree.node(node).brick;
  bricks_[brick.value].lit = step, bricks_[brick.value].sun = toSun_;
  light.push_back({brick.value, at.corner, at.level});
}

std::uint32_t Relight::follow(const Tree& tree, std::span<const BrickIndex> sampled, std::uint64_t step, std::uint32_t most,
                              std::vector<BrickJob>& jobs) {
  old_.clear();
  for (const BrickIndex brick : sampled) {
    const Brick& b = bricks_[brick.value];
    if (!b.waits && b.lit != 0 && b.lit < since_ && b.lit < step) old_.push_back(brick);
  }
  const std::size_t count = std::min<std::size_t>(most, old_.size());
  const auto older = [this](BrickIndex a, BrickIndex b) {
    const std::uint64_t x = bricks_[a.value].lit, y = bricks_[b.value].lit;
    return x != y ? x < y : a.value < b.value;
  };
  std::nth_element(old_.begin(), old_.begin() + std::ptrdiff_t(count), old_.end(), older);
  for (std::size_t i = 0; i < count; ++i) light(tree, tree.owner(old_[i]), step, jobs);
  return std::uint32_t(count);
}

glm::dvec3 Relight::oldestSun(std::span<const BrickIndex> sampled) const {
  const glm::vec3 now(toSun_);
  glm::dvec3 oldest = toSun_;
  float most = 0;
  for (const BrickIndex brick : sampled) {
    const glm::vec3 sun = bricks_[brick.value].sun;
    const float away = glm::length(sun - now);
    if (away > most) most = away, oldest = sun;
  }
  return oldest;
}

void Relight::behind(const Tree& tree, NodeIndex node, std::uint64_t step) {
  const NodeAddress at = tree.address(node);
  if (at.level == 0) return;
  const std::int64_t size = std::int64_t(1) << (32u - at.level), end = std::int64_t(1) << 32u;
  for (int mask = 1; mask < 8; ++mask) {
    const glm::ivec3 offset = away_ * glm::ivec3(mask & 1, (mask >> 1) & 1, mask >> 2);
    if ((offset.x != 0) != ((mask & 1) != 0) || (offset.y != 0) != ((mask & 2) != 0) || (offset.z != 0) != ((mask & 4) != 0))
      continue;  // no sun along it
    const glm::i64vec3 corner = glm::i64vec3(at.corner) + glm::i64vec3(offset) * size;
    if (glm::any(glm::lessThan(corner, glm::i64vec3(0))) || glm::any(glm::greaterThanEqual(corner, glm::i64vec3(end)))) continue;
    const auto neighbour = find(tree, glm::uvec3(corner), at.level);
    if (!neighbour || !isLit(tree, *neighbour)) continue;
    const BrickIndex brick = tree.node(*neighbour).brick;
    Brick& b = bricks_[brick.value];
    if (b.waits || b.lit >= step) continue;
    b.waits = true;
    due_.push_back({step + kLater, brick});
  }
}

void Relight::take(const Tree& tree, std::uint64_t step, std::vector<BrickJob>& jobs) {
  for (; !due_.empty() && due_.front().step <= step; due_.pop_front()) {
    const BrickIndex brick = due_.front().brick;
    bricks_[brick.value].waits = false;
    const NodeIndex node = tree.owner(brick);  // another one than then, if the brick was freed: no harm
    if (!isLit(tree, node) || tree.node(node).brick != brick || bricks_[brick.value].lit >= step) continue;
    light(tree, node, step, jobs);
  }
}

void Relight::sweep(const Tree& tree, std::uint64_t step, std::uint32_t most, std::vector<BrickJob>& jobs) {
  for (std::uint32_t looked = 0; unswept_ > 0 && most > 0 && looked < kLookedAt; ++looked, --unswept_) {
    const BrickIndex brick{cursor_};
    sunLeft_ -= sunLeft_ > 0 ? 1 : 0;
    cursor_ = (cursor_ + 1) % std::uint32_t(bricks_.size());
    const Brick& b = bricks_[brick.value];
    if (b.waits || b.lit == 0 || b.lit >= since_) continue;  // 0: never used
    const NodeIndex node = tree.owner(brick);
    if (brick.isZero() || !isLit(tree, node) || tree.node(node).brick != brick) continue;
    light(tree, node, step, jobs);
    --most;
  }
}

}  // namespace welkin
