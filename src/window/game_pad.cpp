#include "welkin/window/game_pad.h"

#include <algorithm>

namespace welkin::window {
namespace {

// 0 within the dead part, from there on evenly to 1 in the direction of the stick, so that it neither jumps nor sticks to an axis.
glm::dvec2 moved(glm::dvec2 stick) {
  const double length = glm::length(stick);
  if (!(length > kPadDead)) return glm::dvec2(0);
  return stick * (std::min((length - kPadDead) / (1 - kPadDead), 1.0) / length);
}

}  // namespace

void addPad(const GamePad& pad, double dt_s, app::FlyInput& input) {
  const glm::dvec2 left = moved(pad.left), right = moved(pad.right);
  input.move += glm::dvec3(left.x, (pad.rightTrigger - pad.leftTrigger) / 2, left.y);
  input.turn_rad += glm::dvec2(right.x, -right.y) * (kPadTurnRate_rad_s * dt_s);
  input.roll += double(pad.rightShoulder) - double(pad.leftShoulder);
  input.fast = input.fast || pad.fast;
}

}  // namespace welkin::window
