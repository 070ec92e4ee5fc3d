#pragma once
// Draws a debug view (docs/debug-views.md) beside the picture, which stays as it is.
#include "render/march/cloud_passes.h"
#include "welkin/render/composite/composite_pass.h"
#include "welkin/render/debug_view.h"

namespace welkin {

class DebugPass {
 public:
  // `clouds`: null without clouds; their views then show none. Fails in one line where a shader does not compile.
  static Result<DebugPass> create(gpu::MemoryAccount& account, DebugView view, const CloudPasses* clouds, const CompositePass& composite,
                                  const Quality& quality, int width, int height);
  Result<void> resize(gpu::MemoryAccount& account, int width, int height);
  // After the picture of the same frame, with what that has bound. turn: CloudPasses::turn().
  void draw(const CloudPasses* clouds, const CompositePass& composite, const shared::CameraBlock& camera, double exposure_ev,
            glm::ivec2 turn) const;
  DebugView view() const { return view_; }
  const gpu::Texture& picture() const { return picture_; }  // RGBA8, sRGB values
  std::vector<float> values() const;                        // rows from the top

 private:
  DebugView view_ = DebugView::None;
  int width_ = 0, height_ = 0;
  gpu::Program program_;  // none: no pixel has a value
  gpu::Texture values_, picture_;
};

}  // namespace welkin
