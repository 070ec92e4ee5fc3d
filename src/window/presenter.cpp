#include "presenter.h"

namespace welkin::window {

void Presenter::show(Canvas& canvas, app::Size window, GLenum between) const {
  const gpu::Texture& picture = canvas.texture;
  glNamedFramebufferTexture(frame_, GL_COLOR_ATTACHMENT0, picture.id(), 0);
  glViewport(0, 0, window.width, window.height);
  glBlitNamedFramebuffer(frame_, 0, 0, 0, picture.spec().width, picture.spec().height, 0, window.height, window.width, 0,
                         GL_COLOR_BUFFER_BIT, between);
  if (canvas.read) glDeleteSync(canvas.read);
  canvas.read = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

void Presenter::clear(app::Size window) const {
  glViewport(0, 0, window.width, window.height);
  constexpr float kNight[4] = {0.010f, 0.012f, 0.018f, 1};
  glClearNamedFramebufferfv(0, GL_COLOR, 0, kNight);
}

}  // namespace welkin::window
