#pragma once
// Where the camera will be when what is decided now can be seen: edits of frame k are drawn at k + 2, what they generate comes back
// and is drawn from about k + 5 on.
#include <glm/glm.hpp>

#include "welkin/octree/node_view.h"
#include "welkin/stream/streamer.h"

namespace welkin {

class Motion {
 public:
  // The camera of the next frame. `cut`: it did not fly there.
  void advance(const SelectionCamera& camera, bool cut);
  // Position, slack, floor and frustum; the altitudes of cloud are left to the caller.
  SelectionView view() const;
  bool changed() const { return changed_; }  // since the frame before, so that selection could want something else

 private:
  SelectionCamera camera_;
  glm::dvec3 step_m_{}, velocity_m_{};  // last step; what to expect of the next ones
  double near_m_ = 0;
  bool first_ = true, changed_ = true;
};

}  // namespace welkin
