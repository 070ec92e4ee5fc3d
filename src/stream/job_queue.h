#pragma once
// Bricks to be generated: those that wait, and those handed out whose result is not back.
#include <deque>
#include <optional>
#include <vector>

#include "welkin/octree/tree.h"
#include "welkin/stream/streamer.h"

namespace welkin {

class JobQueue {
 public:
  explicit JobQueue(Tree& tree) : tree_(tree) {}

  // Queues every pending brick of the group (Group::unqueued says which).
  void add(GroupIndex group);
  // The best `most` jobs, coarse and near first: by Group::key, level, corner.
  std::vector<BrickJob> take(std::uint32_t most);
  // The node that a result is for, or none if its brick is gone since. Results come in the order of take(); one that is left out
  // counts as lost and is queued again.
  std::optional<NodeIndex> match(std::uint32_t brick);
  std::uint64_t bytes() const;

 private:
  struct Out {
    BrickIndex brick;
    std::uint32_t ticket;
    bool current(const Tree& tree) const { return tree.brickPool().isLive(brick) && tree.ticket(brick) == ticket; }
  };
  void requeue(NodeIndex node);

  Tree& tree_;
  std::vector<GroupIndex> waiting_;
  std::vector<bool> listed_;  // by group: it is in waiting_
  std::deque<Out> out_;
};

}  // namespace welkin
