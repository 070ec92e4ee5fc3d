#pragma once
// What a game pad does to the camera: the left stick moves, the right one looks around, triggers are down and up, shoulders roll.
#include <glm/glm.hpp>

#include "welkin/app/fly_camera.h"

namespace welkin::window {

inline constexpr double kPadDead = 0.15;          // sticks at rest are not quite at 0
inline constexpr double kPadTurnRate_rad_s = 0.9;  // of a stick at its end

// As SDL and GLFW tell it: sticks -1..1, right and towards oneself; triggers -1 (not pressed) .. 1.
struct GamePad {
  glm::dvec2 left{0}, right{0};
  double leftTrigger = -1, rightTrigger = -1;
  bool leftShoulder = false, rightShoulder = false, fast = false;
};

// Added to what keys and mouse do in a frame of dt_s.
void addPad(const GamePad& pad, double dt_s, app::FlyInput& input);

}  // namespace welkin::window
