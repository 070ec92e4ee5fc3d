#pragma once
// Which bricks are lit once more. A sample's light looks a third of a brick towards the sun at its brick's own level (pass/light), so
// a brick that was lit before its neighbours towards the sun came has light of coarser ones at those faces: the faces show as dark lines.
// What is farther away is smooth; for its sake every brick is lit again at leisure when others have come, until none has come since.
// A sun that moves makes all light old. Bricks are lit again, the oldest of those that rays sample first, once it has moved by kStale_rad:
// shadows of the sun's own disc are as soft as that. Once it rests all light is made exact.
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
  // Of these bricks, which rays sample, adds `most` of those whose light is old, the oldest first. Returns how many are added.
  std::uint32_t follow(const Tree& tree, std::span<const BrickIndex> sampled, std::uint64_t step, std::uint32_t most, std::vector<BrickJob>& light);
  // Adds `most` of those that were lit before the last others came, or the sun moved.
  void sweep(const Tree& tree, std::uint64_t step, std::uint32_t most, std::vector<BrickJob>& light);
  bool done() const { return due_.empty() && unswept_ == 0; }
  bool sunMoved() const { return sunLeft_ > 0; }                     // light is made again for its sake
  bool exact() const { return sunLeft_ == 0 && toSun_ == litFor_; }  // all of it is of now's sun
  // Of these bricks the place of the sun that one is lit for and that is farthest from now's.
  glm::dvec3 oldestSun(std::span<const BrickIndex> sampled) const;
  std::size_t bytes() const { return bricks_.capacity() * sizeof(Brick); }

 private:
  struct Due {
    std::uint64_t step;
    BrickIndex brick;
  };
  struct Brick {
    std::uint64_t lit = 0;  // step; the first is 1
    glm::vec3 sun{0};       // that it is lit for
    bool waits = false;     // in due_
  };
  void behind(const Tree& tree, NodeIndex node, std::uint64_t step);
  void light(const Tree& tree, NodeIndex node, std::uint64_t step, std::vector<BrickJob>& light);

  glm::dvec3 toSun_{0}, litFor_{0};  // now; what the present round lights all bricks for
  bool begun_ = false;
  glm::ivec3 away_{0};   // from the sun: signs
  std::deque<Due> due_;  // in order of their steps
  std::vector<Brick> bricks_;
  std::vector<BrickIndex> old_;             // of one follow()
  std::uint64_t since_ = 0;                 // the last step in which bricks came, or light got old
  std::uint32_t cursor_ = 0, unswept_ = 0;  // the next brick to look at; how many are left to look at
  std::uint32_t sunLeft_ = 0;               // the same for the sun's sake
};

}  // namespace welkin
