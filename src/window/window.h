#pragma once
// A window of the desktop with an OpenGL 4.5 core context (GLFW), and what happened to it since one last looked.
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "welkin/app/options.h"
#include "welkin/core/result.h"
#include "welkin/window/placement.h"

struct GLFWwindow;

namespace welkin::window {

struct Press {
  int key, mods;  // of GLFW
};

struct Events {
  std::vector<Press> pressed;  // in order, without repeats of held keys
  std::vector<std::filesystem::path> dropped;
  double wheel = 0;  // notches
};

class Window {
 public:
  // The context is current in this thread. Fails in one line: no display, or no OpenGL 4.5.
  static Result<std::unique_ptr<Window>> open(const Placement& wanted, const std::string& title);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  Events poll(double mostWait_s);  // waits for an event for so long
  bool closing() const;
  void close();
  void hide();
  Placement placement();     // to open the next one there; where it lay before it was maximised or covered the screen
  app::Size pixels() const;  // 0 x 0 while minimised
  double scale() const;      // of letters and lines on this monitor
  void setTitle(const std::string& title);
  void swap();
  void toggleFullScreen();
  void captureMouse(bool captured);
  bool mouseCaptured() const { return captured_; }
  GLFWwindow* handle() const { return window_; }
  GLFWwindow* hidden(int i) const { return hidden_[std::size_t(i)]; }  // 0, 1: never shown: contexts that share this one's objects, for other threads

 private:
  Window() = default;
  void rememberPlace();
  GLFWwindow* window_ = nullptr;
  std::array<GLFWwindow*, 2> hidden_{};
  Events events_;
  bool captured_ = false;
  int place_[4] = {};  // before full screen: x, y, width, height
  Placement normal_;   // while it is neither maximised nor full screen nor minimised, a second ago at most
  double remembered_s_ = -1;
};

}  // namespace welkin::window
