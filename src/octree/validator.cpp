// fmt first: the shared prelude's macro F is also the name of its template parameters.
#include "welkin/octree/validator.h"

#include <fmt/format.h>

#include "welkin/octree/max_code.h"

namespace welkin {
namespace {

// A stored value is rounded to 16 bits, and processors may differ by 1e-5 of the greatest extinction.
constexpr float kStoredTolerance = 1.0f / 65535 + 1e-5f;

class Validator {
 public:
  Validator(const Tree& tree, float maxExtinction_per_m) : tree_(tree), maxExtinction_per_m_(maxExtinction_per_m) {}

  std::string operator()() {
    brickSeen_.assign(tree_.brickPool().highWater(), false);
    if (std::string wrong = group(kRootGroup, NodeIndex{}, true); !wrong.empty()) return wrong;
    if (groups_ != tree_.groupPool().used())
      return fmt::format("{} groups hang in the tree, the pool says {}", groups_, tree_.groupPool().used());
    if (bricks_ + 1 != tree_.brickPool().used())
      return fmt::format("{} bricks are owned, the pool says {}", bricks_ + 1, tree_.brickPool().used());
    if (pending_ != tree_.pendingBricks()) return fmt::format("{} bricks are pending, the tree says {}", pending_, tree_.pendingBricks());
    for (std::uint32_t level = 0; level <= shared::kMaxDepth; ++level) {
      if (byLevel_[level] != tree_.bricksAtLevel(level))
        return fmt::format("{} bricks at level {}, the tree says {}", byLevel_[level], level, tree_.bricksAtLevel(level));
    }
    if (tree_.groupPool().used() > tree_.groupPool().capacity()) return "more groups than the capacity";
    if (tree_.brickPool().used() > tree_.brickPool().capacity()) return "more bricks than the capacity";
    return {};
  }

 private:
  std::string group(GroupIndex index, NodeIndex parent, bool aboveReachable) {
    ++groups_;
    if (groups_ > tree_.groupPool().used()) return "a group hangs in the tree twice";
    if (!tree_.isLive(index)) return fmt::format("group {} hangs in the tree and is free", index.value);
    const Group& g = tree_.group(index);
    const std::string name = fmt::format("group {}", index.value);
    if (g.parent != parent) return name + " has another parent than the node that has it";
    if (index != kRootGroup) {
      const NodeAddress at = tree_.address(parent);
      if (at.corner != g.corner || at.level != g.level) return name + " has another address than its parent";
      if (g.level >= shared::kMaxDepth) return name + " is too deep";
    }
    if (g.published && g.pending) return name + " is published with a brick missing";
    if (g.reachable != (g.published && aboveReachable)) return name + " is reachable and should not be, or the reverse";
    std::uint32_t pending = 0, bricks = 0;
    const std::uint32_t count = index == kRootGroup ? 1 : 8;
    for (std::uint32_t octant = 0; octant < count; ++octant) {
      const NodeIndex i = nodeOf(index, octant);
      pending += tree_.node(i).pending;
      bricks += !tree_.node(i).brick.isZero();
      if (std::string wrong = node(i, g.reachable); !wrong.empty()) return wrong;
    }
    if (pending != g.pending || bricks != g.bricks) return name + " counts its bricks wrongly";
    return {};
  }

  std::string node(NodeIndex i, bool reachable) {
    const Node& n = tree_.node(i);
    const std::string name = fmt::format("node {}", i.value);
    const NodeAddress at = tree_.address(i);
    if (at.corner != shared::nodeCorner(at.corner, at.level)) return name + " has a corner off its level's lattice";
    if (n.source.empty() && (n.children.valid() || !n.brick.isZero())) return name + " is empty by its source and has a brick or children";
    if (n.brick.isZero()) {
      if (n.pending) return name + " waits for a brick that it does not own";
      if (n.own != ResidentBounds{}) return name + " has resident bounds without a brick";
    } else {
      const std::uint32_t b = n.brick.value;
      if (!tree_.brickPool().isLive(n.brick)) return fmt::format("{} owns brick {}, which is free", name, b);
      if (brickSeen_[b]) return fmt::format("brick {} is owned twice", b);
      brickSeen_[b] = true;
      if (tree_.owner(n.brick) != i) return fmt::format("brick {} names another owner than {}", b, name);
      ++bricks_;
      ++byLevel_[at.level];
      if (n.pending) {
        ++pending_;
        if (n.own != ResidentBounds{}) return name + " has resident bounds before its brick is there";
      } else if (!(n.own.max > 0) || n.own.min > n.own.max) {
        return name + " keeps an empty brick";
      } else if (maxExtinction_per_m_ > 0 && n.own.max > n.source.hi / maxExtinction_per_m_ + kStoredTolerance) {
        return fmt::format("{} (level {}, corner {} {} {}) stores up to {} where its source promised at most {}", name, at.level,
                           at.corner.x, at.corner.y, at.corner.z, n.own.max, n.source.hi / maxExtinction_per_m_);
      }
    }
    ResidentBounds joined = n.own;
    if (n.children.valid()) {
      if (std::string wrong = group(n.children, i, reachable); !wrong.empty()) return wrong;
      if (tree_.group(n.children).published) {
        for (std::uint32_t octant = 0; octant < 8; ++octant) joined = join(joined, tree_.node(nodeOf(n.children, octant)).joined);
      }
    }
    if (joined != n.joined) return name + " has resident bounds other than its brick's and its children's";
    const std::uint32_t code = shared::wordMaxCode(tree_.words(i).word);
    if ((code == 0) != !(joined.max > 0)) return name + " says empty and is not, or the reverse";
    if (shared::maxCodeValue(code) < std::min(joined.max, 1.0f)) return name + " says less than it holds";
    return {};
  }

  const Tree& tree_;
  float maxExtinction_per_m_;
  std::vector<bool> brickSeen_;
  std::uint32_t groups_ = 0, bricks_ = 0, pending_ = 0;
  std::uint32_t byLevel_[shared::kMaxDepth + 1] = {};
};

}  // namespace

std::string validateTree(const Tree& tree, float maxExtinction_per_m) { return Validator(tree, maxExtinction_per_m)(); }

}  // namespace welkin
