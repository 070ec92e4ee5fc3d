#include "welkin/octree/selection.h"

#include <algorithm>
#include <bit>
#include <functional>

namespace welkin {
namespace {

using Candidate = Selection::Candidate;

// Keys are not negative, so their bits order as integers; the candidate's number, in order of discovery, breaks ties.
std::uint64_t packEntry(float key, std::size_t candidate) {
  return (static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(key)) << 32) | static_cast<std::uint32_t>(candidate);
}

class Run {
 public:
  Run(const Tree& tree, const RootFrame& root, const SelectionView& view, const SelectionSettings& settings, const BoundsFunction& bounds,
      Selection& out)
      : tree_(tree), root_(root), look_(root, view), settings_(settings), bounds_(bounds), out_(out) {
    // New candidates far beyond what the last run accepted wait outside the heap: most of a converged tree's frontier.
    laterFrom_ = out.detail > 0 ? static_cast<float>(std::min(out.detail * 1.3, 1e30)) : 1e30f;
  }

  void operator()() {
    out_.keep.assign(tree_.groupPool().highWater(), 0);
    out_.key.assign(tree_.groupPool().highWater(), 0);
    out_.keep[0] = 1;
    out_.added.clear();
    out_.candidates.clear();
    out_.heap.clear();
    out_.later.clear();
    out_.complete = true;
    out_.residentDetail = kGreatestDetail;
    bricksLeft_ = settings_.brickCapacity - 1 - (tree_.node(kRootNode).brick.isZero() ? 0 : 1);
    groupsLeft_ = settings_.groupCapacity - 1;
    const Node& rootNode = tree_.node(kRootNode);
    if (!rootNode.source.empty()) offer({}, 0, 0, kRootNode, 0, NodeView::Seen{}, 0);
    double stoppedAt = -1;
    while (const Candidate* best = top()) {
      const float biased = std::bit_cast<float>(static_cast<std::uint32_t>(out_.heap.front() >> 32));
      if (settings_.detailLimit > 0 && biased >= settings_.detailLimit) {
        stoppedAt = settings_.detailLimit;
        break;
      }
      if (!fits(*best)) {
        stoppedAt = biased;
        break;
      }
      const Candidate chosen = *best;
      pop();
      accept(chosen);
    }
    for (const std::uint64_t entry : out_.heap) reject(out_.candidates[static_cast<std::uint32_t>(entry)]);
    for (const std::uint64_t entry : out_.later) reject(out_.candidates[static_cast<std::uint32_t>(entry)]);
    // If nothing stopped it, all in view is as deep as it goes: so much detail that it is sampled there, up to the far side of the
    // last node (a node's diagonal is under 4 child edges) and without the blend with the parent in the last quarter of the range.
    const double detail = stoppedAt >= 0 ? stoppedAt : (greatestRaw_ + 4) * 1.6;
    out_.detail = std::min(detail, settings_.detailLimit > 0 ? settings_.detailLimit : kGreatestDetail);
  }

 private:
  GroupIndex childrenOf(const Candidate& c) const { return c.node == kNoIndex ? GroupIndex{} : tree_.node(NodeIndex{c.node}).children; }

  // Next in order, or null. Candidates set aside come back once the heap has nothing better.
  const Candidate* top() {
    if (!out_.later.empty() &&
        (out_.heap.empty() || std::bit_cast<float>(static_cast<std::uint32_t>(out_.heap.front() >> 32)) >= laterFrom_)) {
      out_.heap.insert(out_.heap.end(), out_.later.begin(), out_.later.end());
      out_.later.clear();
      laterFrom_ = 1e30f;
      std::make_heap(out_.heap.begin(), out_.heap.end(), std::greater<>());
    }
    return out_.heap.empty() ? nullptr : &out_.candidates[static_cast<std::uint32_t>(out_.heap.front())];
  }

  void pop() {
    std::pop_heap(out_.heap.begin(), out_.heap.end(), std::greater<>());
    out_.heap.pop_back();
  }

  // A new group needs room for eight bricks however few it may take: whether anything fits does not depend on which is first, so
  // that a tremble of the camera cannot fill the last few places with another group each time.
  bool fits(const Candidate& c) const {
    if (const GroupIndex g = childrenOf(c); g.valid()) return tree_.group(g).bricks <= bricksLeft_ && groupsLeft_ >= 1;
    return bricksLeft_ >= 8 && groupsLeft_ >= 1;
  }

  void offer(glm::uvec3 corner, std::uint32_t level, std::uint32_t octant, NodeIndex node, std::uint32_t parentAdded,
             const NodeView::Seen& above, float parentKey) {
    const NodeView::Seen seen = look_.look({corner, level}, above);
    const double size_m = root_.nodeSize_m(level + 1), raw = seen.drawn_m / size_m;
    double key = seen.distance_m / size_m * seen.penalty;
    key = std::max(key, static_cast<double>(parentKey));  // never before its parent, whatever the rounding
    Candidate c{corner,
                level,
                node.value,
                parentAdded,
                static_cast<float>(key),
                static_cast<float>(raw),
                static_cast<std::uint8_t>(octant),
                seen.outside,
                seen.hidden,
                seen.deep};
    const bool exists = childrenOf(c).valid();
    const float biased = exists ? static_cast<float>(key / kHysteresis) : c.key;
    const std::uint64_t entry = packEntry(biased, out_.candidates.size());
    out_.candidates.push_back(c);
    if (!exists && biased >= laterFrom_) {
      out_.later.push_back(entry);
    } else {
      out_.heap.push_back(entry);
      std::push_heap(out_.heap.begin(), out_.heap.end(), std::greater<>());
    }
  }

  void reject(const Candidate& c) {
    if (!c.outside && !c.hidden) out_.residentDetail = std::min(out_.residentDetail, static_cast<double>(c.raw));
  }

  void accept(const Candidate& c) {
    const NodeView::Seen seen{0, 0, c.outside != 0, c.hidden != 0, c.deep != 0, 1};
    const GroupIndex existing = childrenOf(c);
    if (!existing.valid() && out_.added.size() >= settings_.maxNewGroups) {
      out_.complete = false;
      reject(c);
      return;
    }
    if (seen.visible()) greatestRaw_ = std::max(greatestRaw_, static_cast<double>(c.raw));
    --groupsLeft_;
    const std::uint32_t childLevel = c.level + 1;
    if (existing.valid()) {
      const Group& g = tree_.group(existing);
      out_.keep[existing.value] = 1;
      out_.key[existing.value] = c.key;
      bricksLeft_ -= g.bricks;
      if (!g.reachable) reject(c);
      if (childLevel >= settings_.depth) return;
      for (std::uint32_t octant = 0; octant < 8; ++octant) {
        const NodeIndex child = nodeOf(existing, octant);
        if (tree_.node(child).source.empty() || (childLevel >= settings_.emptyFrom && tree_.node(child).foundEmpty())) continue;
        offer(shared::childCorner(c.corner, c.level, octant), childLevel, octant, child, 0, seen, c.key);
      }
      return;
    }
    NewGroup group;
    group.parent = NodeIndex{c.node};
    group.parentAdded = c.parentAdded;
    group.octant = c.octant;
    group.key = c.key;
    const auto self = static_cast<std::uint32_t>(out_.added.size());
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      group.bounds[octant] = bounds_(shared::childCorner(c.corner, c.level, octant), childLevel);
      if (!group.bounds[octant].empty()) --bricksLeft_;
    }
    out_.added.push_back(group);
    reject(c);
    if (childLevel >= settings_.depth) return;
    for (std::uint32_t octant = 0; octant < 8; ++octant) {
      if (group.bounds[octant].empty()) continue;
      offer(shared::childCorner(c.corner, c.level, octant), childLevel, octant, NodeIndex{}, self, seen, c.key);
    }
  }

  const Tree& tree_;
  const RootFrame& root_;
  NodeView look_;
  const SelectionSettings& settings_;
  const BoundsFunction& bounds_;
  Selection& out_;
  std::uint32_t bricksLeft_ = 0, groupsLeft_ = 0;
  float laterFrom_;
  double greatestRaw_ = 0;
};

}  // namespace

std::uint64_t Selection::bytes() const {
  return keep.capacity() + key.capacity() * sizeof(float) + added.capacity() * sizeof(NewGroup) +
         candidates.capacity() * sizeof(Candidate) + (heap.capacity() + later.capacity()) * sizeof(std::uint64_t);
}

void select(const Tree& tree, const RootFrame& root, const SelectionView& view, const SelectionSettings& settings,
            const BoundsFunction& bounds, Selection& out) {
  Run(tree, root, view, settings, bounds, out)();
}

}  // namespace welkin
