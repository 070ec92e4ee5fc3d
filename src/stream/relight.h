#pragma once
// Which bricks are lit once more. A sample's light looks a third of a brick towards the sun at its brick's own level (pass/light), so
// a brick that was lit before its neighbours towards the sun came has light of coarser ones at those faces: the faces show as dark lines.
// What is farther away is smooth; for its sake every brick is lit again at leisure when others have come, until none has come since.
#include <deque>
#include <span>
#include <vector>

#include "welkin/octree/tree.h"
#include "welkin/stream/streamer.h"

namespace welkin {

class Relight {
 public:
  // toSun: planet frame; only its signs count.
  Relight(glm::dvec3 toSun, std::uint32_t brickCapacity);
  // The bricks of these nodes are lit in this step. Their neighbours away from the sun that were lit before are to be lit once more,
  // soon or at leisure.
  void lit(const Tree& tree, std::span<const NodeIndex> nodes, std::uint64_t step, bool soon);
  // Adds those whose time has come: neighbours of one brick come in the same few steps, and count once.
  void take(const Tree& tree, std::uint64_t step, std::vector<BrickJob>& light);
  // Adds `most` of those that were lit before the last others came.
  void sweep(const Tree& tree, std::uint64_t step, std::uint32_t most, std::vector<BrickJob>& light);
  bool done() const { return due_.empty() && unswept_ == 0; }

 private:
  void behind(const Tree& tree, NodeIndex node, std::uint64_t step);
  struct Due {
    std::uint64_t step;
    BrickIndex brick;
  };
  struct Brick {
    std::uint64_t lit = 0;  // step; the first is 1
    bool waits = false;     // in due_
  };
  glm::ivec3 away_;      // signs
  std::deque<Due> due_;  // in order of their steps
  std::vector<Brick> bricks_;
  std::uint64_t since_ = 0;                 // the last step in which bricks came
  std::uint32_t cursor_ = 0, unswept_ = 0;  // the next brick to look at; how many are left to look at
};

}  // namespace welkin
