#pragma once
// Keys and mouse: what they do to the camera, and which of them ask for something.
#include "model.h"
#include "window.h"

namespace welkin::window {

class Controls {
 public:
  // Moves the camera. `mouse`, `keys`: false while the interface has them.
  void fly(Model& model, Window& window, const Events& events, bool mouse, bool keys, double dt_s);
  // Keys that are pressed once.
  static void press(Model& model, Window& window, Press key);

 private:
  enum class Drag { None, Look, Orbit };
  Drag drag_ = Drag::None;
  glm::dvec2 last_px_{0};
  bool wasCaptured_ = false;
};

// What the help shows: keys, and what they do.
struct KeyLine {
  const char *keys, *what;
};
extern const std::array<KeyLine, 19> kKeyLines;

}  // namespace welkin::window
