#pragma once
// Which nodes should be split, seen from a camera, within the pools: a pure function. Best first from the root; the key of a split
// is K = distance / child's edge, the detail (nodes a distance) below which somebody would look at the children. Penalties for what
// is not seen; existing groups have an advantage, so a camera that trembles changes nothing. Ties go to the one found first, which is
// the coarser one, then the lower address: nothing depends on where things lie in the pools.
#include <cstdint>
#include <functional>
#include <vector>

#include "welkin/octree/node_view.h"
#include "welkin/octree/tree.h"

namespace welkin {

inline constexpr double kHysteresis = 1.15;     // advantage of a group that exists
inline constexpr double kGreatestDetail = 1e6;  // K when nothing limits it

struct SelectionSettings {
  std::uint32_t depth = 16;
  std::uint32_t brickCapacity = 0, groupCapacity = 0;  // as StreamSettings
  double detailLimit = 0;                              // 0: none
  std::uint32_t maxNewGroups = 1024;                   // most splits decided at once; the rest is deferred
  std::uint32_t emptyFrom = shared::kMaxDepth + 1;     // from this level on a node found empty is not split (DensitySource)
};

// Conservative bounds of a node, from the density source. Must be pure.
using BoundsFunction = std::function<SourceBounds(glm::uvec3 corner, std::uint32_t level)>;

struct NewGroup {
  NodeIndex parent;               // the existing node to split, or none:
  std::uint32_t parentAdded = 0;  // then child `octant` of this earlier entry
  std::uint32_t octant = 0;
  float key = 0;
  ChildBounds bounds;
};

struct Selection {
  std::vector<std::uint8_t> keep;  // by group: it stays (else it is merged)
  std::vector<float> key;          // by group that stays: its key
  std::vector<NewGroup> added;     // in the order to be made
  double detail = 0;               // K that the budget (or the limit) allowed
  double residentDetail = 0;  // least K that any visible split asks for that is not reachable now: rejected, deferred, or not there yet
  bool complete = true;       // nothing was deferred

  // Scratch, kept to save allocations.
  struct Candidate {
    glm::uvec3 corner;
    std::uint32_t level;
    std::uint32_t node;  // existing node, or kNoIndex
    std::uint32_t parentAdded;
    float key, raw;
    std::uint8_t octant, outside, hidden, deep;
  };
  std::vector<Candidate> candidates;
  std::vector<std::uint64_t> heap, later;
  std::uint64_t bytes() const;
};

void select(const Tree& tree, const RootFrame& root, const SelectionView& view, const SelectionSettings& settings,
            const BoundsFunction& bounds, Selection& out);

}  // namespace welkin
