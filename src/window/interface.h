#pragma once
// Dear ImGui in our window: set up once, a frame between begin() and end().
#include "window.h"

namespace welkin::window {

class Interface {
 public:
  explicit Interface(Window& window);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;
  void begin();                                    // letters follow the monitor's scale
  void end();                                      // draws
  void setScale(double asked) { asked_ = asked; }  // in place of the monitor's; 0: that one
  bool wantsMouse() const;
  bool busy() const;       // a field is held
  bool wantsKeys() const;  // a field of text is being edited

 private:
  void dress();  // style and letters at scale_
  Window& window_;
  double scale_ = 0, asked_ = 0;
};

}  // namespace welkin::window
