#pragma once
// Brings a picture of any size onto the window.
#include <glad/gl.h>

#include "painter.h"

namespace welkin::window {

class Presenter {
 public:
  Presenter() { glCreateFramebuffers(1, &frame_); }
  ~Presenter() { glDeleteFramebuffers(1, &frame_); }
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;
  void prepare(app::Size window) const;  // before there is a picture: software translates programs for the first one, 35 ms
  void show(Canvas& picture, app::Size window, GLenum between = GL_LINEAR) const;  // stretched; between: GL_LINEAR or GL_NEAREST
  void showWhole(const gpu::Texture& picture, app::Size window) const;             // at its own shape, in the middle
  void clear(app::Size window) const;

 private:
  GLuint frame_ = 0;
};

}  // namespace welkin::window
