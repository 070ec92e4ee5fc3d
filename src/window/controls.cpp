#include "controls.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

#include "welkin/window/game_pad.h"

namespace welkin::window {
namespace {

constexpr double kTurnRate_rad_s = 0.9;  // of the arrow keys
constexpr double kPi = 3.14159265358979323846;

double axis(GLFWwindow* w, int more, int less) { return double(glfwGetKey(w, more)) - double(glfwGetKey(w, less)); }
bool held(GLFWwindow* w, int key) { return glfwGetKey(w, key) == GLFW_PRESS; }
bool button(GLFWwindow* w, int which) { return glfwGetMouseButton(w, which) == GLFW_PRESS; }

glm::dvec2 cursor_px(GLFWwindow* w) {
  glm::dvec2 at;
  glfwGetCursorPos(w, &at.x, &at.y);
  return at;
}

// Where the cursor points, view frame.
glm::dvec3 pointed(const Model& model, GLFWwindow* w, glm::dvec2 at_px) {
  int width = 1, height = 1;
  glfwGetWindowSize(w, &width, &height);
  width = std::max(width, 1), height = std::max(height, 1);
  return app::directionThrough(model.camera.view(), {2 * at_px.x / width - 1, 1 - 2 * at_px.y / height}, double(width) / height);
}

void gamePad(app::FlyInput& in, double dt_s) {
  GLFWgamepadstate pad;
  int found = GLFW_JOYSTICK_1;  // the first that is one
  while (found <= GLFW_JOYSTICK_LAST && !glfwGetGamepadState(found, &pad)) ++found;
  if (found > GLFW_JOYSTICK_LAST) return;
  const auto axis = [&pad](int which) { return double(pad.axes[which]); };
  addPad({.left = {axis(GLFW_GAMEPAD_AXIS_LEFT_X), axis(GLFW_GAMEPAD_AXIS_LEFT_Y)},
          .right = {axis(GLFW_GAMEPAD_AXIS_RIGHT_X), axis(GLFW_GAMEPAD_AXIS_RIGHT_Y)},
          .leftTrigger = axis(GLFW_GAMEPAD_AXIS_LEFT_TRIGGER),
          .rightTrigger = axis(GLFW_GAMEPAD_AXIS_RIGHT_TRIGGER),
          .leftShoulder = pad.buttons[GLFW_GAMEPAD_BUTTON_LEFT_BUMPER] == GLFW_PRESS,
          .rightShoulder = pad.buttons[GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER] == GLFW_PRESS,
          .fast = pad.buttons[GLFW_GAMEPAD_BUTTON_A] == GLFW_PRESS},
         dt_s, in);
}

}  // namespace

const std::array<KeyLine, 19> kKeyLines{{{"W A S D", "forward, left, back, right"},
                                         {"E, Space", "up"},
                                         {"Q, Shift", "down"},
                                         {"Z, X", "roll"},
                                         {"arrow keys", "look around"},
                                         {"Ctrl", "five times as fast"},
                                         {"wheel", "speed"},
                                         {"drag, left button", "look around"},
                                         {"drag, right button", "move the planet under the cursor"},
                                         {"M", "look with the mouse alone, on and off"},
                                         {"Home", "back to where it began"},
                                         {"Tab", "panels on and off"},
                                         {"1 to 9, 0, F, B", "open or close a panel"},
                                         {"F11", "full screen on and off"},
                                         {"R", "record the flight; again: stop and save it"},
                                         {"Ctrl Z, Ctrl Shift Z", "undo, redo"},
                                         {"F12, Shift F12", "picture as seen; converged picture"},
                                         {"H or ?", "these keys"},
                                         {"Ctrl Q", "close the window"}}};

void Controls::fly(Model& model, Window& window, const Events& events, bool mouse, bool keys, double dt_s) {
  GLFWwindow* w = window.handle();
  app::FlyInput in;
  if (keys) {
    in.move = {axis(w, GLFW_KEY_D, GLFW_KEY_A),
               std::min(1, glfwGetKey(w, GLFW_KEY_E) + glfwGetKey(w, GLFW_KEY_SPACE)) -
                   std::min(1, glfwGetKey(w, GLFW_KEY_Q) + glfwGetKey(w, GLFW_KEY_LEFT_SHIFT)),
               axis(w, GLFW_KEY_S, GLFW_KEY_W)};
    in.fast = held(w, GLFW_KEY_LEFT_CONTROL) || held(w, GLFW_KEY_RIGHT_CONTROL);
    in.roll = in.fast ? 0 : axis(w, GLFW_KEY_X, GLFW_KEY_Z);  // Ctrl Z undoes
    in.turn_rad = glm::dvec2(axis(w, GLFW_KEY_RIGHT, GLFW_KEY_LEFT), axis(w, GLFW_KEY_UP, GLFW_KEY_DOWN)) * (kTurnRate_rad_s * dt_s);
  }
  gamePad(in, dt_s);
  const glm::dvec2 at = cursor_px(w);
  if (wasCaptured_ != window.mouseCaptured()) last_px_ = at;  // the cursor jumps
  wasCaptured_ = window.mouseCaptured();
  const Drag before = drag_;
  const bool look = button(w, GLFW_MOUSE_BUTTON_LEFT), orbit = button(w, GLFW_MOUSE_BUTTON_RIGHT);
  if (drag_ == Drag::None && mouse && !window.mouseCaptured()) {  // a drag that began on the picture goes on over a panel
    if (look)
      drag_ = Drag::Look;
    else if (orbit && model.camera.grab(pointed(model, w, at)))
      drag_ = Drag::Orbit;
  }
  if (drag_ == Drag::Orbit && !orbit) model.camera.release();
  if ((drag_ == Drag::Look && !look) || (drag_ == Drag::Orbit && !orbit)) drag_ = Drag::None;
  if ((drag_ == Drag::Look && before == Drag::Look) || window.mouseCaptured()) {
    int width = 1, height = 1;
    glfwGetWindowSize(w, &width, &height);
    const double pixel_rad = model.camera.view().fov_deg * kPi / 180 / std::max(height, 1);
    in.turn_rad += glm::dvec2(at.x - last_px_.x, last_px_.y - at.y) * pixel_rad;
  }
  if (mouse) in.wheel = events.wheel;
  if (drag_ == Drag::Orbit) model.camera.drag(pointed(model, w, at));
  model.camera.advance(in, dt_s);
  last_px_ = at;
}

void Controls::press(Model& model, Window& window, Press press) {
  const int key = press.key;
  const auto named = std::find(kPanelKeys.begin(), kPanelKeys.end(), key);  // GLFW's codes of letters and digits are these
  if (named != kPanelKeys.end()) {
    const auto panel = std::size_t(named - kPanelKeys.begin());
    model.open[panel] = !model.open[panel] || !model.sidebar;
    if (model.open[panel]) model.sidebar = true, model.showNow = Panel(panel);
  }
  if (key == GLFW_KEY_H || (key == GLFW_KEY_SLASH && (press.mods & GLFW_MOD_SHIFT))) model.help = !model.help;
  if (key == GLFW_KEY_TAB) model.sidebar = !model.sidebar;
  if (key == GLFW_KEY_ESCAPE) model.help = false, model.wanted.stopFlight = true, window.captureMouse(false);
  if (key == GLFW_KEY_M) window.captureMouse(!window.mouseCaptured());
  if (key == GLFW_KEY_HOME) model.camera.flyTo(model.home);
  if (key == GLFW_KEY_F11) window.toggleFullScreen();
  if (key == GLFW_KEY_F12) (press.mods & GLFW_MOD_SHIFT ? model.wanted.convergedPicture : model.wanted.picture) = true;
  if (key == GLFW_KEY_Z && (press.mods & GLFW_MOD_CONTROL)) press.mods& GLFW_MOD_SHIFT ? model.redo() : model.undo();
  if (key == GLFW_KEY_R && !model.flight) {
    if (model.deck.mode() == Deck::Mode::Recording)
      model.wanted.endRecording = model.wanted.savePath = true;
    else
      model.deck.record();
  }
  if (key == GLFW_KEY_Q && (press.mods & GLFW_MOD_CONTROL)) window.close();
}

}  // namespace welkin::window
