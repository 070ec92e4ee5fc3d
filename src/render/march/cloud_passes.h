#pragma once
// The march and the reprojection: clouds of every pixel, of which one in 16 is marched a frame and the rest is moved from the last.
#include <map>
#include <optional>
#include <string>

#include "render/tree/resident_tree.h"
#include "welkin/gpu/timer.h"
#include "welkin/render/renderer.h"
#include "welkin/shared/camera.glsl.h"
#include "welkin/shared/cloud_weights.glsl.h"

namespace welkin {

// How a view is seen by shaders, and what the next frame needs of it to reproject.
struct ViewFrame {
  shared::CameraBlock block;
  glm::dvec3 position_m, forward, right, up;  // unit axes
  double tanX, tanY;
};
ViewFrame viewFrame(const View& view, double planetRadius_m, double shellTop_m, int width, int height);

class CloudPasses {
 public:
  static Result<CloudPasses> create(gpu::MemoryAccount& account, const ResidentTree& tree, int width, int height, const FramePlan& plan,
                                    const Quality& quality);
  Result<void> use(gpu::MemoryAccount& account, const Quality& quality);  // its integrator, step rule and skipEmpty, compiled once each, and spread
  // Expects tree, camera, counters and sky bound. Leaves the new clouds bound at WK_CLOUD_LIGHT_UNIT and (if read) WK_CLOUD_AUX_UNIT.
  // `seen_ev`: exposure that the picture will be seen at, if that is known; without it no pixel is spread. `refined`: the tree has changed.
  void run(const ViewFrame& view, FrameMode mode, const Scene& scene, std::optional<double> seen_ev, bool refined, gpu::PassTimer& timer);
  // Marches the whole picture into the spare target, which is bound as the new clouds; history stays as it is.
  void preview(const Scene& scene, std::optional<double> seen_ev);
  Result<void> preview(gpu::MemoryAccount& account, const Scene& scene, std::span<const glm::ivec2> pixels);  // of these pixels only
  // The same with what each pixel's ray brings given, rows from the top, instead of marched.
  Result<void> show(gpu::MemoryAccount& account, const Scene& scene, std::span<const shared::CloudWeights> clouds);
  // Other targets: what history there is comes along, stretched; it gets finer as its pixels are marched again.
  Result<void> resize(gpu::MemoryAccount& account, int width, int height);
  // For debug views: the march with watch.glsl in it, and where the last run() took its pixels from. turn: which pixel of each 4 x 4 was
  // marched; negative: all of them were.
  Result<gpu::Program> compileWatched(const Quality& quality, const gpu::Defines& debug) const;
  bool hasHistory() const { return history_; }
  void bindAges() const;
  glm::ivec2 turn() const { return turn_; }
  void forget() { haveHistory_ = false; }  // the next frame marches every pixel

 private:
  void march(const gpu::Program& program, glm::ivec2 offset, int target) const;
  void marchWhole(const Scene& scene, std::optional<double> seen_ev, int target) const;  // every pixel, or as scene.quality.spread has it
  void marchList(int target) const;
  void clearList() const;
  void showSpare() const;
  Result<void> useRules(const Quality& quality);
  enum class PixelSet { All, Sixteenth, List, Given };  // PIXELS of march.comp
  Result<gpu::Program> compile(const Quality& quality, PixelSet pixels) const;
  Result<void> createTargets(gpu::MemoryAccount& account, int width, int height);
  Result<void> createList(gpu::MemoryAccount& account);
  int spare() const { return history_ ? 1 - current_ : 0; }  // the next run() writes every pixel of it
  void marchSpare(const gpu::Program& program, const Scene& scene, unsigned groupsX, unsigned groupsY) const;
  void setLight(const gpu::Program& program, const Scene& scene) const;
  void show(int target) const;  // to whom puts the picture together
  void setMotion(const gpu::Program& program, const ViewFrame& view) const;
  int width_ = 0, height_ = 0, current_ = 0;
  bool haveHistory_ = false;
  std::uint32_t phase_ = 0;  // which of the 16 pixels is next
  glm::ivec2 turn_{-1};
  ViewFrame last_{};
  bool auxWanted_ = true;
  bool history_ = true;  // else every frame marches all pixels, into the one target there is
  gpu::Texture light_[2], aux_[2], age_[2], change_;
  gpu::Buffer pixels_;
  struct Programs {
    gpu::Program all, sixteenth, list;
  };
  gpu::Defines defines_;              // of all marches
  std::map<std::string, Programs> marches_;  // by what their quality defines
  Programs* march_ = nullptr;   // the one in use
  gpu::Program reproject_, given_, spread_;    // given, spread: made when they are first asked for
};

}  // namespace welkin
