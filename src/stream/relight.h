#pragma once
// Which bricks are lit once more. A sample's light looks a third of a brick towards the sun at its brick's own level (pass/light), so
// a brick that was lit before its neighbours towards the sun came has light of coarser ones at those faces: the faces show as dark lines.
// What is farther away is smooth; for its sake every brick is lit again at leisure when others have come, until none has come since.
// A sun that moves makes all light old. Bricks are lit again one after another, round and round, so always about the oldest, and not
// before it has moved by kStale_rad: shadows of the sun's own disc are as soft as that. Once it rests all light is made exact.
#include <deque>
#include <span>
#include <vector>

#include "welkin/octree/tree.h"
#include "welkin/stream/streamer.h"

namespace welkin {

class Relight {
 public:
  explicit Relight(std::uint32_t brickCapacity);
  // Where the sun stands in this step: unit, the tree's frame; 0: there is none, and nothing is lit again.
  void sun(glm::dvec3 toSun, std::uint64_t step);
  // The bricks of these nodes are lit in this step. Their neighbours away from the sun that were lit before are to be lit once more,
  // soon or at leisure.
  void lit(const Tree& tree, std::span<const NodeIndex> nodes, std::uint64_t step, bool soon);
  // Adds those whose time has come: neighbours of one brick come in the same few steps, and count once.
  void take(const Tree& tree, std::uint64_t step, std::vector<BrickJob>& light);
  // Adds `most` of those that were lit before the last others came.
  void sweep(const Tree& tree, std::uint64_t step, std::uint32_t most, std::vector<BrickJob>& light);
  bool done() const { return due_.empty() && unswept_ == 0; }
  bool sunMoved() const { return sunLeft_ > 0; }  // all light is made again for its sake, and is not yet
  // Where the sun stood when the oldest light there is was asked for; 0: nothing was lit, or there is no sun.
  glm::dvec3 oldestSun(const Tree& tree);

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
  struct Sun {
    std::uint64_t from;  // step
    glm::dvec3 to;
  };
  glm::ivec3 away_{0};     // from the sun: signs
  std::deque<Sun> suns_;   // in order; the last is now's, the first that of the oldest light
  glm::dvec3 litFor_{0};   // what all bricks are lit for when the present round ends
  std::deque<Due> due_;  // in order of their steps
  std::vector<Brick> bricks_;
  std::uint64_t since_ = 0;                 // the last step in which bricks came
  std::uint32_t cursor_ = 0, unswept_ = 0, sunLeft_ = 0;  // the next brick to look at; how many are left to look at; for the sun
};

}  // namespace welkin
