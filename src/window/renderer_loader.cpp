#include "renderer_loader.h"

#include <glad/gl.h>

namespace welkin::window {
namespace {

constexpr int kFirstFrames = 8;  // unseen: a level of the tree each, so that the first picture has its clouds

}  // namespace

void RendererLoader::begin(const Scene& scene, const RenderSettings& settings, const View& view) {
  busy_ = true;
  begun_ms_ = gpu::wall_ms();
  const std::lock_guard lock(box_->mutex);
  const std::uint64_t number = ++box_->wanted;
  thread_.run([box = box_, scene, settings, view, number, &context = context_] {
    {
      const std::lock_guard asked(box->mutex);
      if (box->wanted != number) return;  // nobody waits for it any more
    }
    Made made = Renderer::create(context, scene, settings);
    if (made) {
      for (int i = 0; i < kFirstFrames; ++i) (*made)->frame(view, FrameMode::Reprojected, 0);
    }
    glFinish();
    const std::lock_guard done(box->mutex);
    if (box->wanted == number) box->made.emplace(std::move(made));
  });
}

double RendererLoader::since_s() const { return busy_ ? (gpu::wall_ms() - begun_ms_) / 1000 : 0; }

std::optional<RendererLoader::Made> RendererLoader::take() {
  const std::lock_guard lock(box_->mutex);
  std::optional<Made> made = std::move(box_->made);
  box_->made.reset();
  if (made) busy_ = false;
  return made;
}

void RendererLoader::end(std::unique_ptr<Renderer> renderer) {
  if (!renderer) return;
  thread_.run([old = std::make_shared<std::unique_ptr<Renderer>>(std::move(renderer))] { old->reset(); });
}

}  // namespace welkin::window
