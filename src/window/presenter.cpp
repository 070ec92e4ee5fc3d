#include "presenter.h"

#include <algorithm>
#include <cmath>

namespace welkin::window {

void Presenter::prepare(app::Size window) const {
  GLuint picture = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &picture);
  glTextureStorage2D(picture, 1, GL_RGBA8, 1, 1);
  glNamedFramebufferTexture(frame_, GL_COLOR_ATTACHMENT0, picture, 0);
  glBlitNamedFramebuffer(frame_, 0, 0, 0, 1, 1, 0, window.height, window.width, 0, GL_COLOR_BUFFER_BIT, GL_LINEAR);
  glNamedFramebufferTexture(frame_, GL_COLOR_ATTACHMENT0, 0, 0);
  glDeleteTextures(1, &picture);
}

void Presenter::show(Canvas& canvas, app::Size window, GLenum between) const {
  const gpu::Texture& picture = canvas.texture;
  glNamedFramebufferTexture(frame_, GL_COLOR_ATTACHMENT0, picture.id(), 0);
  glViewport(0, 0, window.width, window.height);
  glBlitNamedFramebuffer(frame_, 0, 0, 0, picture.spec().width, picture.spec().height, 0, window.height, window.width, 0,
                         GL_COLOR_BUFFER_BIT, between);
  if (canvas.read) glDeleteSync(canvas.read);
  canvas.read = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

void Presenter::showWhole(const gpu::Texture& picture, app::Size window) const {
  clear(window);
  const auto& spec = picture.spec();
  const double scale = std::min(double(window.width) / spec.width, double(window.height) / spec.height);
  const int width = int(std::lround(spec.width * scale)), height = int(std::lround(spec.height * scale));
  const int x = (window.width - width) / 2, y = (window.height - height) / 2;
  glNamedFramebufferTexture(frame_, GL_COLOR_ATTACHMENT0, picture.id(), 0);
  glBlitNamedFramebuffer(frame_, 0, 0, 0, spec.width, spec.height, x, y + height, x + width, y, GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

void Presenter::clear(app::Size window) const {
  glViewport(0, 0, window.width, window.height);
  constexpr float kNight[4] = {0.010f, 0.012f, 0.018f, 1};
  glClearNamedFramebufferfv(0, GL_COLOR, 0, kNight);
}

}  // namespace welkin::window
