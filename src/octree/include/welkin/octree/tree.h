#pragma once
// The octree on the CPU: the mirror of the node buffer, and what only the CPU knows. No GL, no threads, no policy: selection
// decides, the stream layer obeys, this keeps the structure sound.
//
// A group's life: split() allocates it with a brick for every child that may hold cloud -> each brick is generated
// (setGenerated) -> publish() once none is missing -> reachable, as soon as all groups above it are -> merge().
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "welkin/octree/index.h"
#include "welkin/octree/index_pool.h"
#include "welkin/shared/octree.glsl.h"

namespace welkin {

// Extinction in 1/m, from the density source, conservative. Decides splitting and brick creation, never ray skipping.
struct SourceBounds {
  float lo = 0, hi = 0;
  bool empty() const { return hi <= 0; }
};
using ChildBounds = std::array<SourceBounds, 8>;

// What is stored: extinction as a fraction of the source's greatest, and the altitudes of the non-zero part. Exact.
struct ResidentBounds {
  float min = 0, max = 0;
  float base_m = std::numeric_limits<float>::infinity(), top_m = -std::numeric_limits<float>::infinity();
  bool operator==(const ResidentBounds&) const = default;
};
ResidentBounds join(const ResidentBounds& a, const ResidentBounds& b);

struct NodeAddress {
  glm::uvec3 corner{};
  std::uint32_t level = 0;
  bool operator==(const NodeAddress&) const = default;
};

struct Node {
  GroupIndex children;
  BrickIndex brick;  // zero brick: nothing stored here
  SourceBounds source;
  ResidentBounds own;     // of its brick; zero without one
  ResidentBounds joined;  // own, joined with the children if they are published
  bool pending = false;   // owns a brick that is not generated yet
  bool touched = false;   // its words changed since the last flush
  bool foundEmpty() const { return !source.empty() && brick.isZero() && !pending; }  // might have held cloud, and did not
};

struct Group {
  NodeIndex parent;           // none for the root's group
  glm::uvec3 corner{};        // of the parent
  std::uint8_t level = 0;     // of the parent
  std::uint8_t pending = 0;   // children whose brick is not generated yet
  std::uint8_t bricks = 0;    // children that own a brick
  std::uint8_t unqueued = 0;  // bit per child: brick not handed out for generation yet (kept by the stream layer)
  bool published = false;     // all bricks generated, words may be read
  bool reachable = false;     // and so are all groups above: rays see it
  float key = 0;              // selection's key of the split (kept by the stream layer): order of generation
};

// What changed for rays since the last clear().
struct TreeChanges {
  std::vector<NodeIndex> touched;  // nodes whose words changed (Node::touched tells the still valid ones)
  std::vector<NodeIndex> dirty;    // nodes below which a ray may see something else
  std::vector<NodeIndex> shown;    // nodes with a brick that became reachable
  void clear();
};

class Tree {
 public:
  // At least one group (the root's) and two bricks (the zero brick and the root's).
  Tree(std::uint32_t groupCapacity, std::uint32_t brickCapacity);

  // Gives the root its bounds and, unless empty, its brick.
  void plantRoot(SourceBounds bounds);
  // Splits a leaf above kMaxDepth. Pools must have room (one group, a brick for each child with non-empty bounds).
  GroupIndex split(NodeIndex parent, const ChildBounds& bounds);
  // Frees the children of `parent` and everything below them, deepest first.
  void merge(NodeIndex parent, TreeChanges& changes);
  // The brick of `node` is generated. Found empty, it is freed at once and the node uses the zero brick.
  void setGenerated(NodeIndex node, const ResidentBounds& found);
  // All bricks of the group are there (pending == 0): lets rays see it, now or when the groups above are published.
  void publish(GroupIndex group, TreeChanges& changes);

  const Node& node(NodeIndex i) const { return nodes_[i.value]; }
  const Group& group(GroupIndex i) const { return groups_[i.value]; }
  Group& group(GroupIndex i) { return groups_[i.value]; }
  NodeAddress address(NodeIndex i) const;
  NodeIndex parentOf(NodeIndex i) const { return groups_[i.value / 8].parent; }
  bool isLive(GroupIndex i) const { return i == kRootGroup || groupPool_.isLive(i); }
  // As the GPU stores it.
  shared::NodeWords words(NodeIndex i) const;
  // Forgets that the words of a node changed; true if they had, and the node can be reached.
  bool takeTouched(NodeIndex i);

  NodeIndex owner(BrickIndex brick) const { return bricks_[brick.value].owner; }
  // Counts how often the brick was freed: a result for an older ticket is of a brick that is gone.
  std::uint32_t ticket(BrickIndex brick) const { return bricks_[brick.value].ticket; }

  const IndexPool<GroupIndex>& groupPool() const { return groupPool_; }
  const IndexPool<BrickIndex>& brickPool() const { return brickPool_; }
  std::uint32_t nodeCount() const { return 1 + 8 * (groupPool_.used() - 1); }
  std::uint32_t pendingBricks() const { return pendingBricks_; }
  std::uint32_t bricksAtLevel(std::uint32_t level) const { return bricksByLevel_[level]; }
  std::uint64_t bytes() const;

 private:
  struct Brick {
    NodeIndex owner;
    std::uint32_t ticket = 0;
  };
  bool giveBrick(NodeIndex node, std::uint32_t level);
  void takeBrick(NodeIndex node, std::uint32_t level);
  void freeBelow(GroupIndex group);
  void touch(NodeIndex node, TreeChanges& changes);
  ResidentBounds joinOf(NodeIndex node) const;
  void rejoin(NodeIndex node, TreeChanges& changes);
  void show(GroupIndex group, TreeChanges& changes);

  IndexPool<GroupIndex> groupPool_;
  IndexPool<BrickIndex> brickPool_;
  std::vector<Node> nodes_;
  std::vector<Group> groups_;
  std::vector<Brick> bricks_;
  std::uint32_t pendingBricks_ = 0;
  std::uint32_t bricksByLevel_[shared::kMaxDepth + 1] = {};
};

}  // namespace welkin
