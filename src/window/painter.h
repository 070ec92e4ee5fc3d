#pragma once
// A thread with a GL context of its own (it shares objects with the window's) that makes a renderer, draws its pictures and ends it. A
// renderer never leaves the context that it was made in: drivers translate programs for each context, and the window waits for none of it.
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "welkin/app/options.h"
#include "welkin/app/picture.h"
#include "welkin/render/renderer.h"
#include "welkin/window/retry.h"

struct GLFWwindow;

namespace welkin::window {

// A picture that the window may read, top row first, until it lets go of it.
struct Canvas {
  gpu::MemoryAccount account{~0ull};  // its own: it may end in either thread
  gpu::Texture texture;
  GLsync read = nullptr;  // behind the window's last reading of it
  ~Canvas();
};

// What the next picture is to be, and what changes from it on.
struct Order {
  View view;
  FrameMode mode = FrameMode::Reprojected;
  DebugView debug = DebugView::None;
  app::Size size;
  double time_s = 0;       // of the scene
  double sinceLast_s = 0;  // in the window, since the order before
  std::uint32_t bricksPerFrame = 256;
  std::optional<Quality> march;
  std::optional<Output> output;
  std::optional<Scene> air;
  bool keep = false;  // its pixels are wanted
};

struct Kept {
  Image8 image;
  app::PictureState state;  // without checksums of data
};

struct Painted {
  std::shared_ptr<Canvas> canvas;
  app::Size size;
  double ms = 0;  // that it took
  FrameStats stats;
  double shownDetail = 0;  // Renderer::shownDetail
  FramePlan plan;
  std::map<std::string, std::uint64_t> memory;  // bytes by name
  std::vector<std::string> notes, failed;       // of the renderer; of what was ordered, one line each
  bool airRefused = false;                      // this change of the air needs a new renderer
  std::optional<Kept> kept;
  std::optional<DebugNumbers> debug;  // if it is a debug view
};

class Painter {
 public:
  explicit Painter(GLFWwindow* hidden);
  ~Painter();  // after what it is at

  // A renderer in place of the one that it has, with its tree begun for this view. Of several asked for, only the last is made.
  void make(const Scene& scene, const RenderSettings& settings, const View& view);
  std::optional<Result<void>> made();  // said once
  void end();                          // the renderer, its worker and its memory; waits for nothing

  void draw(Order order);  // one at a time
  bool drawing() const { return drawing_; }
  // What draw() asked for; waits for it for so long at most. If it comes later, it wakes Window::poll.
  std::optional<Painted> take(double most_ms);
  std::uint64_t glMessages() const { return glMessages_; }

 private:
  void run(std::function<void()> job);
  void work();
  void dropRenderer();
  Painted paint(const Order& order);
  void resize(app::Size size, Painted& painted);
  void setDebugView(DebugView view, Painted& painted);
  std::shared_ptr<Canvas> freeCanvas(app::Size size);

  GLFWwindow* hidden_;
  mutable std::mutex mutex_;  // over all down to the next line
  std::condition_variable more_, painted_;
  std::deque<std::function<void()>> jobs_;
  std::optional<Painted> done_;
  std::optional<Result<void>> made_;
  std::uint64_t wanted_ = 0;  // number of the newest make()
  bool late_ = false;         // the window looked for a picture that was not there yet

  bool drawing_ = false;  // the window's

  gpu::Context* context_ = nullptr;  // the thread's, with all that follows
  std::unique_ptr<Renderer> renderer_;
  app::Size size_;
  Retry<std::pair<int, int>> resizing_, copying_;
  Retry<DebugView> debugging_;
  std::array<std::shared_ptr<Canvas>, 2> canvases_;

  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> glMessages_{0};
  std::thread thread_;
};

}  // namespace welkin::window
