#include "motion.h"

namespace welkin {
namespace {

constexpr double kAhead = 4.5;  // frames: the middle of k + 2 (edits drawn) and k + 7 (their bricks drawn, two frames of queue)
constexpr double kSlack = 3;    // frames: half of that span, and a fifth for acceleration
constexpr double kDrawn = 2, kDrawnSlack = 1;  // frames: until the edits are drawn, and for acceleration
// In frames of motion: data nearer than this would be left behind before it is there. Refining reaches 15 % farther than sampling
// plus kSlack, which at this distance covers the latency.
constexpr double kNear = 8;
constexpr double kNearDecay = 0.8;      // a frame, after the camera slowed down
constexpr double kNegligible_m = 0.05;  // below the voxel of the finest level of an Earth (level 24: 0.11 m)

}  // namespace

void Motion::advance(const SelectionCamera& camera, bool cut) {
  const glm::dvec3 step = camera.position_m - camera_.position_m, before = step_m_;
  const double nearBefore_m = near_m_;
  const glm::dvec3 velocityBefore_m = velocity_m_;
  const bool same = !first_ && camera.position_m == camera_.position_m && camera.forward == camera_.forward &&
                    camera.right == camera_.right && camera.up == camera_.up && camera.tanHalfFovX == camera_.tanHalfFovX &&
                    camera.tanHalfFovY == camera_.tanHalfFovY;
  // Only a steady flight is extrapolated; a jump or a tremble is not.
  const bool steady = !cut && !first_ && glm::length(step - before) <= 0.5 * glm::length(step);
  velocity_m_ = steady ? step : glm::dvec3(0);
  step_m_ = cut || first_ ? glm::dvec3(0) : step;
  near_m_ = cut ? 0 : std::max(kNear * glm::length(velocity_m_), kNearDecay * near_m_);
  if (near_m_ < kNegligible_m) near_m_ = 0;
  camera_ = camera;
  changed_ = first_ || !same || near_m_ != nearBefore_m || velocity_m_ != velocityBefore_m;
  first_ = false;
}

SelectionView Motion::view() const {
  SelectionView view;
  view.position_m = camera_.position_m + kAhead * velocity_m_;
  view.slack_m = kSlack * glm::length(velocity_m_);
  view.drawnOffset_m = (kDrawn - kAhead) * velocity_m_;
  view.drawnSlack_m = kDrawnSlack * glm::length(velocity_m_);
  view.near_m = near_m_;
  view.forward = camera_.forward;
  view.right = camera_.right;
  view.up = camera_.up;
  view.tanHalfFovX = camera_.tanHalfFovX;
  view.tanHalfFovY = camera_.tanHalfFovY;
  return view;
}

}  // namespace welkin
