#include "painter.h"

#ifdef __linux__
#include <malloc.h>
#endif

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <glad/gl.h>

#include "welkin/app/draw.h"
#include "welkin/gpu/context.h"
#include "welkin/gpu/program.h"

namespace welkin::window {
namespace {

constexpr int kFirstFrames = 8;  // unseen: a level of the tree each, so that the first picture has its clouds

// The heaps of many threads keep the pages of what was freed: 100 MiB after a renderer of 2 GiB. 5 to 9 ms.
void trimHeap() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace

Canvas::~Canvas() {
  if (read) glDeleteSync(read);
}

Painter::Painter(GLFWwindow* hidden) : hidden_(hidden), thread_([this] { work(); }) {}

Painter::~Painter() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  more_.notify_one();
  thread_.join();
}

void Painter::run(std::function<void()> job) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  more_.notify_one();
}

void Painter::make(const Scene& scene, const RenderSettings& settings, const View& view) {
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    number = ++wanted_;
    made_.reset();
  }
  run([this, scene, settings, view, number] {
    const auto wanted = [&] {
      const std::lock_guard lock(mutex_);
      return !stop_ && wanted_ == number;
    };
    if (!wanted()) return;
    dropRenderer();
    auto made = Renderer::create(*context_, scene, settings);
    if (made) {
      renderer_ = std::move(*made);
      size_ = {settings.width, settings.height};
      for (int i = 0; i < kFirstFrames && wanted(); ++i)  // the last one whole: pixels of eight trees side by side show as dots
        renderer_->frame(view, i + 1 < kFirstFrames ? FrameMode::Reprojected : FrameMode::Full, 0);
    }
    const std::lock_guard lock(mutex_);
    if (wanted_ != number) return;
    if (made)
      made_.emplace();
    else
      made_.emplace(made.error());
  });
}

std::optional<Result<void>> Painter::made() {
  const std::lock_guard lock(mutex_);
  return std::exchange(made_, std::nullopt);
}

void Painter::end() {
  run([this] {
    dropRenderer();
    canvases_ = {};
  });
}

void Painter::dropRenderer() {
  if (!renderer_) return;
  renderer_.reset();
  trimHeap();
}

void Painter::draw(Order order) {
  drawing_ = true;
  run([this, order = std::move(order)] {
    Painted painted = paint(order);
    const std::lock_guard lock(mutex_);
    done_.emplace(std::move(painted));
    painted_.notify_one();
    if (std::exchange(late_, false)) glfwPostEmptyEvent();
  });
}

std::optional<Painted> Painter::take(double most_ms) {
  std::unique_lock lock(mutex_);
  if (!drawing_) return {};
  if (!painted_.wait_for(lock, std::chrono::duration<double, std::milli>(most_ms), [this] { return done_.has_value(); })) {
    late_ = true;
    return {};
  }
  drawing_ = false;
  return std::exchange(done_, std::nullopt);
}

Painted Painter::paint(const Order& order) {
  Painted painted;
  if (!renderer_) return painted;
  const double begun_ms = gpu::wall_ms();
  const auto tried = [&painted](const Result<void>& r) {
    if (!r) painted.failed.push_back(r.error().message);
  };
  resize(order.size, painted);
  if (order.march) tried(renderer_->setMarch(*order.march));
  if (order.output) tried(renderer_->setOutput(*order.output));
  if (order.air) painted.airRefused = !renderer_->setAir(*order.air, Renderer::AirChange::Recompute);
  renderer_->setTime(order.time_s);
  setDebugView(order.debug, painted);
  renderer_->setBricksPerFrame(order.bricksPerFrame);
  painted.stats = renderer_->frame(order.view, order.mode, order.sinceLast_s);
  const gpu::Texture& shown = renderer_->shown();
  painted.size = {shown.spec().width, shown.spec().height};
  const std::pair copied{painted.size.width, painted.size.height};
  if (const double now_ms = gpu::wall_ms(); copying_.due(copied, now_ms)) {
    painted.canvas = freeCanvas(painted.size);
    if (copying_.tried(copied, painted.canvas != nullptr, now_ms)) painted.failed.push_back("no memory for a picture of this size");
  }
  if (painted.canvas) {
    if (painted.canvas->read) glWaitSync(painted.canvas->read, 0, GL_TIMEOUT_IGNORED);
    glCopyImageSubData(shown.id(), GL_TEXTURE_2D, 0, 0, 0, 0, painted.canvas->texture.id(), GL_TEXTURE_2D, 0, 0, 0, 0, painted.size.width,
                       painted.size.height, 1);
  }
  if (order.keep)
    painted.kept = {renderer_->image(),
                    app::stateOf(*renderer_, order.view, painted.stats.exposure_ev, painted.size, order.time_s, false, {})};
  if (renderer_->debugView() != DebugView::None) painted.debug = debugNumbers(renderer_->debugView(), renderer_->debugValues());
  painted.shownDetail = renderer_->shownDetail(order.view);
  painted.plan = renderer_->plan();
  painted.memory = renderer_->memory().byName();
  painted.notes = renderer_->notes();
  glFinish();  // another context reads it
  painted.ms = gpu::wall_ms() - begun_ms;
  return painted;
}

// If it fails, pictures keep the size that they had.
void Painter::resize(app::Size size, Painted& painted) {
  const std::pair wanted{size.width, size.height};
  const double now_ms = gpu::wall_ms();
  if ((size.width == size_.width && size.height == size_.height) || !resizing_.due(wanted, now_ms)) return;
  const auto done = renderer_->resize(size.width, size.height);
  if (done) size_ = size;
  const auto kept = renderer_->resize(size_.width, size_.height);
  if (!resizing_.tried(wanted, done.ok(), now_ms)) return;
  for (const auto* result : {&done, &kept})
    if (!*result) painted.failed.push_back(result->error().message);
}

void Painter::setDebugView(DebugView view, Painted& painted) {
  const double now_ms = gpu::wall_ms();
  if (view == renderer_->debugView() || !debugging_.due(view, now_ms)) return;
  const auto done = renderer_->setDebugView(view);
  if (debugging_.tried(view, done.ok(), now_ms)) painted.failed.push_back(done.error().message);
}

// One that the window does not hold.
std::shared_ptr<Canvas> Painter::freeCanvas(app::Size size) {
  for (auto& canvas : canvases_) {
    if (canvas && canvas.use_count() > 1) continue;
    if (canvas && canvas->texture.spec().width == size.width && canvas->texture.spec().height == size.height) return canvas;
    auto fresh = std::make_shared<Canvas>();
    gpu::TextureSpec spec = renderer_->shown().spec();
    auto texture = gpu::Texture::create(fresh->account, "canvas", spec);
    if (!texture) return nullptr;
    fresh->texture = std::move(*texture);
    return canvas = std::move(fresh);
  }
  return nullptr;
}

void Painter::work() {
  glfwMakeContextCurrent(hidden_);
  gpu::usePool(std::make_shared<gpu::ProgramPool>());  // of this context alone: translated programs are used again by the next renderer
  {
    const auto context = gpu::Context::ofCurrent();
    if (context) context_ = context->get();
    for (;;) {
      std::unique_lock lock(mutex_);
      more_.wait(lock, [this] { return stop_ || !jobs_.empty(); });
      if (stop_) break;
      const std::function<void()> job = std::move(jobs_.front());
      jobs_.pop_front();
      lock.unlock();
      job();
      glFinish();
      if (context_) glMessages_ = context_->debugMessages();
    }
    jobs_.clear();
    renderer_.reset();
    canvases_ = {};
    gpu::usePool(nullptr);
  }
  glfwMakeContextCurrent(nullptr);
}

}  // namespace welkin::window
