#include "render/debug/debug_pass.h"

#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/debug.glsl.h"

namespace welkin {
namespace {

Result<gpu::Program> compile(DebugView view, const CloudPasses* clouds, const CompositePass& composite, const Quality& quality) {
  const gpu::Defines define{{"DEBUG_VIEW", std::to_string(int(view))}};
  switch (view) {
    case DebugView::Air:
      return composite.compileAside(false, define);
    case DebugView::Nan:
      return composite.compileAside(clouds != nullptr, define);
    case DebugView::History:
      return clouds && clouds->hasHistory() ? gpu::Program::compute("pass/debug/history.comp") : gpu::Program{};
    default:
      return clouds ? clouds->compileWatched(quality, define) : gpu::Program{};
  }
}

}  // namespace

Result<DebugPass> DebugPass::create(gpu::MemoryAccount& account, DebugView view, const CloudPasses* clouds, const CompositePass& composite,
                                    const Quality& quality, int width, int height) {
  DebugPass pass;
  pass.view_ = view;
  auto program = compile(view, clouds, composite, quality);
  if (!program) return program.error();
  pass.program_ = std::move(*program);
  if (auto made = pass.resize(account, width, height); !made) return made.error();
  return pass;
}

Result<void> DebugPass::resize(gpu::MemoryAccount& account, int width, int height) {
  width_ = width, height_ = height;
  for (const auto& [texture, format] : {std::pair{&values_, GL_R32F}, {&picture_, GL_RGBA8}}) {
    auto made = gpu::Texture::create(
        account, "debug view", {.format = GLenum(format), .width = width, .height = height, .filter = GL_NEAREST, .frameTarget = true});
    if (!made) return made.error();
    *texture = std::move(*made);
  }
  const float none = shared::kDebugNone;
  const glm::vec4 colour(shared::kDebugNoneColour, 1);
  glClearTexImage(values_.id(), 0, GL_RED, GL_FLOAT, &none);
  glClearTexImage(picture_.id(), 0, GL_RGBA, GL_FLOAT, &colour.x);
  return {};
}

void DebugPass::draw(const CloudPasses* clouds, const CompositePass& composite, const shared::CameraBlock& camera, double exposure_ev,
                     glm::ivec2 turn) const {
  if (!program_.valid()) return;
  if (view_ == DebugView::Air || view_ == DebugView::Nan) {
    composite.runAside(program_, camera, exposure_ev, values_, picture_);
    return;
  }
  if (view_ == DebugView::History) {
    clouds->bindAges();
    program_.set("u_turn", turn);
  }
  program_.set("u_size", glm::ivec2(width_, height_));
  values_.bindImage(0, GL_WRITE_ONLY);
  picture_.bindImage(1, GL_WRITE_ONLY);
  program_.dispatch(static_cast<unsigned>(width_ + 7) / 8, static_cast<unsigned>(height_ + 7) / 8);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

std::vector<float> DebugPass::values() const {
  std::vector<float> out(std::size_t(width_) * std::size_t(height_));
  glGetTextureImage(values_.id(), 0, GL_RED, GL_FLOAT, GLsizei(out.size() * sizeof(float)), out.data());
  return out;
}

}  // namespace welkin
