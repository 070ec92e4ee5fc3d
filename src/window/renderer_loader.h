#pragma once
// Makes renderers beside the frame loop: the picture of the old one stays until the new one is there.
#include <memory>
#include <mutex>
#include <optional>

#include "gl_thread.h"
#include "welkin/render/renderer.h"

namespace welkin::window {

class RendererLoader {
 public:
  RendererLoader(GlThread& thread, gpu::Context& context) : thread_(thread), context_(context) {}
  // In place of one that is still being made. Its tree is begun for this view.
  void begin(const Scene& scene, const RenderSettings& settings, const View& view);
  bool busy() const { return busy_; }
  double since_s() const;  // begin()
  using Made = Result<std::unique_ptr<Renderer>>;
  std::optional<Made> take();           // once it is there
  void end(std::unique_ptr<Renderer>);  // its worker and its memory, without waiting

 private:
  struct Box {  // outlives the loader if a job still runs
    std::mutex mutex;
    std::optional<Made> made;
    std::uint64_t wanted = 0;
  };
  GlThread& thread_;
  gpu::Context& context_;
  std::shared_ptr<Box> box_ = std::make_shared<Box>();
  bool busy_ = false;
  double begun_ms_ = 0;
};

}  // namespace welkin::window
