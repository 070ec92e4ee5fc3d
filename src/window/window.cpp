#include "window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

#include "welkin/core/files.h"

namespace welkin::window {
namespace {

std::string g_problem;  // the newest one: GLFW has no other way to say why it failed

void onError(int, const char* text) { g_problem = oneLine(text); }

Error noWindow(const std::string& what) {
  return Error{
      fmt::format("no window: {}{}{}; `welkin render` draws pictures without one", what, g_problem.empty() ? "" : ": ", g_problem)};
}

Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

void sayWhatIsNeeded() {
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  // Full screen keeps the monitor's mode, so that another window beside it, or a change of monitors, is no reason to vanish.
  glfwWindowHint(GLFW_AUTO_ICONIFY, GLFW_FALSE);
}

std::vector<Area> areas() {
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  std::vector<Area> out(std::size_t(std::max(count, 0)));
  for (std::size_t i = 0; i < out.size(); ++i) glfwGetMonitorWorkarea(monitors[i], &out[i].x, &out[i].y, &out[i].width, &out[i].height);
  std::erase_if(out, [](const Area& a) { return a.width <= 0 || a.height <= 0; });
  return out;
}

}  // namespace

Result<std::unique_ptr<Window>> Window::open(const Placement& wanted, const std::string& title) {
  glfwSetErrorCallback(onError);
  if (!glfwInit()) return noWindow("no display");
  auto made = std::unique_ptr<Window>(new Window);
  sayWhatIsNeeded();
  // Where a window lay is kept in screen coordinates; another size is meant for a monitor of scale 1.
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, wanted.position ? GLFW_FALSE : GLFW_TRUE);
  glfwWindowHint(GLFW_MAXIMIZED, wanted.maximized ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  const Placement place = wanted.position ? onto(areas(), wanted) : wanted;
  made->window_ = glfwCreateWindow(place.size.width, place.size.height, title.c_str(), nullptr, nullptr);
  if (!made->window_) return noWindow("OpenGL 4.5 is needed");
  glfwWindowHint(GLFW_MAXIMIZED, GLFW_FALSE);
  for (auto& hidden : made->hidden_)
    if (!(hidden = glfwCreateWindow(1, 1, "", nullptr, made->window_))) return noWindow("more than one context is needed");
  if (place.position) glfwSetWindowPos(made->window_, place.position->first, place.position->second);
  glfwShowWindow(made->window_);
  made->normal_ = place;
  glfwMakeContextCurrent(made->window_);
  glfwSwapInterval(1);
  glfwSetWindowUserPointer(made->window_, made.get());
  glfwSetKeyCallback(made->window_, [](GLFWwindow* w, int key, int, int action, int mods) {
    if (action == GLFW_PRESS) of(w).events_.pressed.push_back({key, mods});
  });
  glfwSetScrollCallback(made->window_, [](GLFWwindow* w, double, double y) { of(w).events_.wheel += y; });
  glfwSetDropCallback(made->window_, [](GLFWwindow* w, int count, const char** paths) {
    of(w).events_.dropped.insert(of(w).events_.dropped.end(), paths, paths + count);
  });
  return made;
}

Window::~Window() {
  for (GLFWwindow* hidden : hidden_)
    if (hidden) glfwDestroyWindow(hidden);
  if (window_) glfwDestroyWindow(window_);
  glfwTerminate();
}

Events Window::poll(double mostWait_s) {
  if (mostWait_s > 0)
    glfwWaitEventsTimeout(mostWait_s);
  else
    glfwPollEvents();
  if (glfwGetTime() - remembered_s_ > 1) rememberPlace();
  return std::exchange(events_, {});
}

void Window::rememberPlace() {
  remembered_s_ = glfwGetTime();
  if (glfwGetWindowMonitor(window_) || glfwGetWindowAttrib(window_, GLFW_MAXIMIZED) || glfwGetWindowAttrib(window_, GLFW_ICONIFIED)) return;
  int x = 0, y = 0;
  glfwGetWindowPos(window_, &x, &y);
  glfwGetWindowSize(window_, &normal_.size.width, &normal_.size.height);
  normal_.position = std::pair(x, y);
}

Placement Window::placement() {
  rememberPlace();
  normal_.maximized = glfwGetWindowAttrib(window_, GLFW_MAXIMIZED) == GLFW_TRUE;
  return normal_;
}

bool Window::closing() const { return glfwWindowShouldClose(window_); }
void Window::close() { glfwSetWindowShouldClose(window_, GLFW_TRUE); }
void Window::hide() { glfwHideWindow(window_); }
void Window::swap() { glfwSwapBuffers(window_); }
void Window::setTitle(const std::string& title) { glfwSetWindowTitle(window_, title.c_str()); }

app::Size Window::pixels() const {
  app::Size size{0, 0};
  if (!glfwGetWindowAttrib(window_, GLFW_ICONIFIED)) glfwGetFramebufferSize(window_, &size.width, &size.height);
  return size;
}

double Window::scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return std::clamp(double(std::max(x, y)), 0.5, 4.0);
}

void Window::toggleFullScreen() {
  if (glfwGetWindowMonitor(window_)) {
    glfwSetWindowMonitor(window_, nullptr, place_[0], place_[1], place_[2], place_[3], GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  if (!mode) return;
  glfwGetWindowPos(window_, &place_[0], &place_[1]);
  glfwGetWindowSize(window_, &place_[2], &place_[3]);
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::captureMouse(bool captured) {
  captured_ = captured;
  glfwSetInputMode(window_, GLFW_CURSOR, captured ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
}

}  // namespace welkin::window
