#include "job_queue.h"

#include <algorithm>
#include <tuple>

namespace welkin {

void JobQueue::add(GroupIndex group) {
  Group& g = tree_.group(group);
  g.unqueued = 0;
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    if (tree_.node(nodeOf(group, octant)).pending) g.unqueued |= static_cast<std::uint8_t>(1u << octant);
  }
  if (!g.unqueued) return;
  if (listed_.size() <= group.value) listed_.resize(group.value + 1, false);
  if (!listed_[group.value]) waiting_.push_back(group);
  listed_[group.value] = true;
}

void JobQueue::requeue(NodeIndex node) {
  const GroupIndex group = groupOf(node);
  tree_.group(group).unqueued |= static_cast<std::uint8_t>(1u << octantOf(node));
  if (!listed_[group.value]) waiting_.push_back(group);
  listed_[group.value] = true;
}

std::vector<BrickJob> JobQueue::take(std::uint32_t most) {
  std::vector<BrickJob> jobs;
  if (most == 0) return jobs;
  // A group that was freed has no unqueued bricks; one that took its place is listed once.
  std::erase_if(waiting_, [&](GroupIndex g) {
    if (tree_.group(g).unqueued) return false;
    listed_[g.value] = false;
    return true;
  });
  const auto before = [&](GroupIndex a, GroupIndex b) {
    const Group &x = tree_.group(a), &y = tree_.group(b);
    return std::tie(x.key, x.level, x.corner.x, x.corner.y, x.corner.z, a.value) <
           std::tie(y.key, y.level, y.corner.x, y.corner.y, y.corner.z, b.value);
  };
  const std::size_t candidates = std::min<std::size_t>(most, waiting_.size());
  std::partial_sort(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(candidates), waiting_.end(), before);
  for (std::size_t i = 0; i < candidates && jobs.size() < most; ++i) {
    Group& g = tree_.group(waiting_[i]);
    for (std::uint32_t octant = 0; octant < 8 && jobs.size() < most; ++octant) {
      if (!(g.unqueued >> octant & 1)) continue;
      g.unqueued &= static_cast<std::uint8_t>(~(1u << octant));
      const NodeIndex node = nodeOf(waiting_[i], octant);
      const NodeAddress at = tree_.address(node);
      const BrickIndex brick = tree_.node(node).brick;
      jobs.push_back({brick.value, at.corner, at.level});
      out_.push_back({brick, tree_.ticket(brick)});
    }
  }
  return jobs;
}

std::optional<NodeIndex> JobQueue::match(std::uint32_t brick) {
  const auto found = std::find_if(out_.begin(), out_.end(), [&](const Out& o) { return o.brick.value == brick; });
  if (found == out_.end()) return std::nullopt;
  for (auto lost = out_.begin(); lost != found; ++lost) {
    if (lost->current(tree_)) requeue(tree_.owner(lost->brick));
  }
  const Out out = *found;
  out_.erase(out_.begin(), found + 1);
  if (!out.current(tree_)) return std::nullopt;
  return tree_.owner(out.brick);
}

std::uint64_t JobQueue::bytes() const {
  return waiting_.capacity() * sizeof(GroupIndex) + listed_.capacity() / 8 + out_.size() * sizeof(Out);
}

}  // namespace welkin
