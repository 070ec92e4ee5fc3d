#pragma once
// Distinct index types, so that a brick is never looked up among the nodes.
#include <compare>
#include <cstdint>

#include "welkin/shared/octree.glsl.h"

namespace welkin {

inline constexpr std::uint32_t kNoIndex = 0xFFFFFFFFu;

struct NodeIndex {
  std::uint32_t value = kNoIndex;
  bool valid() const { return value != kNoIndex; }
  auto operator<=>(const NodeIndex&) const = default;
};

// A group of eight sibling nodes: nodes 8 g .. 8 g + 7.
struct GroupIndex {
  std::uint32_t value = kNoIndex;
  bool valid() const { return value != kNoIndex; }
  auto operator<=>(const GroupIndex&) const = default;
};

struct BrickIndex {
  std::uint32_t value = shared::kZeroBrick;
  bool isZero() const { return value == shared::kZeroBrick; }
  auto operator<=>(const BrickIndex&) const = default;
};

inline constexpr NodeIndex kRootNode{0};
inline constexpr GroupIndex kRootGroup{0};

inline NodeIndex nodeOf(GroupIndex group, std::uint32_t octant) { return {group.value * 8 + octant}; }
inline GroupIndex groupOf(NodeIndex node) { return {node.value / 8}; }
inline std::uint32_t octantOf(NodeIndex node) { return node.value % 8; }

}  // namespace welkin
