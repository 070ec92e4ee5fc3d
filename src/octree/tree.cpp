#include "welkin/octree/tree.h"

#include <algorithm>
#include <stdexcept>

#include "welkin/octree/max_code.h"

namespace welkin {

ResidentBounds join(const ResidentBounds& a, const ResidentBounds& b) {
  return {std::min(a.min, b.min), std::max(a.max, b.max), std::min(a.base_m, b.base_m), std::max(a.top_m, b.top_m)};
}

void TreeChanges::clear() {
  touched.clear();
  dirty.clear();
  shown.clear();
}

Tree::Tree(std::uint32_t groupCapacity, std::uint32_t brickCapacity)
    : groupPool_(groupCapacity, 1), brickPool_(std::min(brickCapacity, shared::kBrickMask + 1), 1) {
  if (groupCapacity < 1 || brickCapacity < 2) throw std::invalid_argument("octree: at least one node group and two bricks are needed");
  nodes_.resize(8);
  groups_.resize(1);
  bricks_.resize(1);
}

NodeAddress Tree::address(NodeIndex i) const {
  if (i == kRootNode) return {};
  const Group& g = groups_[i.value / 8];
  return {shared::childCorner(g.corner, g.level, octantOf(i)), g.level + 1u};
}

shared::NodeWords Tree::words(NodeIndex i) const {
  const Node& n = nodes_[i.value];
  const bool open = n.children.valid() && groups_[n.children.value].published;
  return {shared::packWord(n.brick.value, maxCodeFor(n.joined.max), 0), open ? n.children.value * 8 : shared::kNoGroup};
}

bool Tree::takeTouched(NodeIndex i) {
  Node& n = nodes_[i.value];
  const bool was = n.touched && groups_[i.value / 8].reachable;
  n.touched = false;
  return was;
}

bool Tree::giveBrick(NodeIndex node, std::uint32_t level) {
  const auto brick = brickPool_.allocate();
  if (!brick) return false;
  if (bricks_.size() <= brick->value) bricks_.resize(brick->value + 1);
  bricks_[brick->value].owner = node;
  nodes_[node.value].brick = *brick;
  nodes_[node.value].pending = true;
  Group& g = groups_[node.value / 8];
  ++g.pending;
  ++g.bricks;
  ++pendingBricks_;
  ++bricksByLevel_[level];
  return true;
}

void Tree::takeBrick(NodeIndex node, std::uint32_t level) {
  Node& n = nodes_[node.value];
  Group& g = groups_[node.value / 8];
  bricks_[n.brick.value].owner = {};
  ++bricks_[n.brick.value].ticket;
  brickPool_.release(n.brick);
  n.brick = {};
  if (n.pending) {
    n.pending = false;
    --g.pending;
    --pendingBricks_;
  }
  --g.bricks;
  --bricksByLevel_[level];
}

void Tree::plantRoot(SourceBounds bounds) {
  nodes_[0].source = bounds;
  if (!bounds.empty()) giveBrick(kRootNode, 0);
}

GroupIndex Tree::split(NodeIndex parent, const ChildBounds& bounds) {
  const NodeAddress at = address(parent);
  if (nodes_[parent.value].children.valid() || at.level >= shared::kMaxDepth)
    throw std::logic_error("octree: split of a node that cannot be");
  const auto index = groupPool_.allocate();
  if (!index) throw std::logic_error("octree: split without a free group");
  if (groups_.size() <= index->value) {
    groups_.resize(index->value + 1);
    nodes_.resize(groups_.size() * 8);
  }
  Group& g = groups_[index->value];
  g = Group{};
  g.parent = parent;
  g.corner = at.corner;
  g.level = static_cast<std::uint8_t>(at.level);
  nodes_[parent.value].children = *index;
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    const NodeIndex child = nodeOf(*index, octant);
    nodes_[child.value] = Node{};
    nodes_[child.value].source = bounds[octant];
    if (!bounds[octant].empty() && !giveBrick(child, at.level + 1)) throw std::logic_error("octree: split without a free brick");
  }
  return *index;
}

void Tree::freeBelow(GroupIndex group) {
  const std::uint32_t level = groups_[group.value].level + 1u;
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    const NodeIndex child = nodeOf(group, octant);
    if (nodes_[child.value].children.valid()) freeBelow(nodes_[child.value].children);
    if (!nodes_[child.value].brick.isZero()) takeBrick(child, level);
    nodes_[child.value] = Node{};
  }
  groups_[group.value] = Group{};
  groupPool_.release(group);
}

void Tree::merge(NodeIndex parent, TreeChanges& changes) {
  const GroupIndex group = nodes_[parent.value].children;
  const bool published = groups_[group.value].published, reachable = groups_[group.value].reachable;
  freeBelow(group);
  nodes_[parent.value].children = {};
  if (reachable) {
    touch(parent, changes);
    changes.dirty.push_back(parent);
  }
  if (published) rejoin(parent, changes);
}

void Tree::setGenerated(NodeIndex node, const ResidentBounds& found) {
  Node& n = nodes_[node.value];
  n.pending = false;
  --groups_[node.value / 8].pending;
  --pendingBricks_;
  if (found.max > 0) {
    n.own = found;
  } else {
    takeBrick(node, address(node).level);
  }
  // The group is not published yet, so nobody above joins this node.
  n.joined = joinOf(node);
}

void Tree::publish(GroupIndex group, TreeChanges& changes) {
  Group& g = groups_[group.value];
  g.published = true;
  if (group != kRootGroup) rejoin(g.parent, changes);
  if (group == kRootGroup || groups_[g.parent.value / 8].reachable) {
    if (g.parent.valid()) touch(g.parent, changes);
    changes.dirty.push_back(g.parent.valid() ? g.parent : kRootNode);
    show(group, changes);
  }
}

void Tree::touch(NodeIndex node, TreeChanges& changes) {
  if (nodes_[node.value].touched) return;
  nodes_[node.value].touched = true;
  changes.touched.push_back(node);
}

ResidentBounds Tree::joinOf(NodeIndex node) const {
  const Node& n = nodes_[node.value];
  ResidentBounds all = n.own;
  if (n.children.valid() && groups_[n.children.value].published) {
    for (std::uint32_t octant = 0; octant < 8; ++octant) all = join(all, nodes_[nodeOf(n.children, octant).value].joined);
  }
  return all;
}

// Brings `node` and the nodes above it up to date. Where a node turns empty or stops being so, all of it is dirty: a map may have
// stored it as the highest empty ancestor of places that did not change themselves.
void Tree::rejoin(NodeIndex node, TreeChanges& changes) {
  while (node.valid()) {
    Node& n = nodes_[node.value];
    const Group& g = groups_[node.value / 8];
    const ResidentBounds now = joinOf(node);
    if (now == n.joined) return;
    if (g.reachable) {
      touch(node, changes);
      if ((now.max > 0) != (n.joined.max > 0)) changes.dirty.push_back(node);
    }
    n.joined = now;
    if (!g.published) return;
    node = g.parent;
  }
}

void Tree::show(GroupIndex group, TreeChanges& changes) {
  groups_[group.value].reachable = true;
  const std::uint32_t count = group == kRootGroup ? 1 : 8;
  for (std::uint32_t octant = 0; octant < count; ++octant) {
    const NodeIndex child = nodeOf(group, octant);
    const Node& n = nodes_[child.value];
    touch(child, changes);
    if (!n.brick.isZero()) changes.shown.push_back(child);
    if (n.children.valid() && groups_[n.children.value].published) show(n.children, changes);
  }
}

std::uint64_t Tree::bytes() const {
  return nodes_.capacity() * sizeof(Node) + groups_.capacity() * sizeof(Group) + bricks_.capacity() * sizeof(Brick) + groupPool_.bytes() +
         brickPool_.bytes();
}

}  // namespace welkin
