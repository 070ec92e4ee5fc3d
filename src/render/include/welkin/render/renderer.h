#pragma once
// Draws a scene: streams the octree around the camera, runs the passes of the frame's plan, hands back pixels and numbers.
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "welkin/core/result.h"
#include "welkin/gpu/context.h"
#include "welkin/gpu/memory.h"
#include "welkin/gpu/resources.h"
#include "welkin/gpu/timer.h"
#include "welkin/octree/tree_data.h"
#include "welkin/physics/scene.h"
#include "welkin/render/debug_view.h"
#include "welkin/render/frame_plan.h"
#include "welkin/shared/camera.glsl.h"
#include "welkin/shared/cloud_weights.glsl.h"
#include "welkin/stream/streamer.h"

namespace welkin {

struct RenderSettings {
  int width = 1280, height = 720;
  std::uint32_t bricksPerFrame = 256;   // generated at most in one frame while flying
  std::uint32_t workerJitterSeed = 0;   // tests of determinism: random delays in the worker
  bool reprojection = true;             // march one pixel in 16 a frame
  double sky_ms = 8;                    // a frame's work on the light of a changed air (Renderer::setAir); at least one slice of it
  double spareDetail = 0;               // the tree reaches so many times the detail of the picture's pixels; 0: as fine as the budget allows
  int brickBits = 16;                   // of each number of a brick, 8 or 16: 8 is for comparisons (docs/decisions/0013)
  double light = 1;                     // reach and samples of the rays to the sun; others than 1 for comparisons
  bool timing = true;                   // per-pass times (on software GL: glFinish after each pass)
  bool waitForEdits = true;             // true: edits of frame k apply at frame k + 2, whatever it takes (deterministic); false: when ready
  std::optional<View> onlyView = {};    // one picture, of this view: frames march every pixel, and of other views would lack parts
  bool linear = true;                   // radiance() will be read; else it may be empty
  double time_s = 0;                    // of the scene: where the sun and the clouds are (Renderer::setTime)
  std::set<std::string> forced = {};    // reasons to leave something out that are not to hold (LeftOut::name)
};

// What the frame's march and the checks counted, whole picture.
struct FrameCounters {
  std::uint64_t nanPixels = 0;       // pixels with a NaN or Inf in any pass; counted, shown in magenta
  std::uint64_t holes = 0;           // rays that met a place without data where data was promised
  std::uint64_t marchedPixels = 0;   // rays marched this frame
  std::uint64_t rejectedPixels = 0;  // of these, pixels whose history was not valid
  std::uint64_t cells = 0, samples = 0;  // map look-ups and brick samples of all rays
};

struct FrameStats {
  std::uint64_t frame = 0;
  std::map<std::string, gpu::PassTime> passes;
  double wall_ms = 0, cpu_ms = 0, wait_ms = 0;   // wait: for the worker's edits, outside the pass times
  FrameCounters counters;
  ResidencyStats residency;
  std::uint32_t bricksGenerated = 0, bricksLit = 0;
  std::uint64_t bytesUsed = 0, bytesBudget = 0, frameTargetBytes = 0;
  double sampleDetail = 0;
  double exposure_ev = 0;  // at which the picture is shown: of the view, of the scene, or metered
  std::string leftOut;     // why all but the background was left out of this frame, or all of it (LeftOut::name); empty: it was drawn
  double lightStale_deg = 0;  // between the sun and where it stood when the oldest light that rays sample was asked for
  double skyProgress = 1;  // of the light of a changed air (Renderer::setAir), 0..1; 1: it is shown
};

enum class FrameMode { Reprojected, Full };  // Full marches every pixel and writes history too

struct Image8 {  // RGBA, top row first, tone-mapped sRGB
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};
struct ImageF {  // RGBA linear radiance before exposure, top row first; A = 1 - cloud transmittance
  int width = 0, height = 0;
  std::vector<float> rgba;
};

class Renderer {
 public:
  static Result<std::unique_ptr<Renderer>> create(gpu::Context& context, const Scene& scene, const RenderSettings& settings);
  ~Renderer();

  // One frame: edits are applied, passes run, the next edits are asked for. sinceLast_s: scene time since the frame before; a metered
  // exposure adapts for so long, without it fully.
  FrameStats frame(const View& view, FrameMode mode = FrameMode::Reprojected, double sinceLast_s = std::numeric_limits<double>::infinity());
  // Streams (draws nothing) until nothing is pending for this view, then returns. `progress` gets 0..1 and may return false to stop.
  FrameStats settle(const View& view, const std::function<bool(double)>& progress = {});
  // The scene's time from the next picture on: the sun goes with the planet's day, clouds with their mean wind (physics/scene_time.h).
  // Light of clouds follows brick by brick, a frame's worth each; FrameStats::lightStale_deg says how far. With onlyView the plan stays that
  // of RenderSettings::time_s: by night it may have left out what a day needs.
  void setTime(double time_s);
  // Planet's albedo, atmosphere, sun and mean wind from now on. Where the sun stands changes at once, as with setTime(). For the rest,
  // Recompute: the old light is drawn until the new one is there; each frame works on it for sky_ms. Keep: at once, and what is scattered
  // more than once stays that of the old air. Fails in one line and changes nothing: values out of range, memory, air where there was none
  // or none where there was some, or (Keep) light that does not fit.
  enum class AirChange { Recompute, Keep };
  Result<void> setAir(const Scene& changed, AirChange how);
  // Integrator, step rule, step, skipEmpty and detail (here: sampled at most) from the next picture on; the tree stays as it is. Fails, and
  // changes nothing that is drawn, when a shader does not compile.
  Result<void> setMarch(const Quality& quality);
  void setBricksPerFrame(std::uint32_t most);
  // Exposure and tone curve from the next picture on. A metered exposure begins anew.
  Result<void> setOutput(const Output& output);
  // Pictures of this size from now on. Tree, light and exposure stay; the picture's history comes along, stretched.
  Result<void> resize(int width, int height);
  // From the next picture on image() and shown() are this view in false colours (docs/debug-views.md); None: the picture again, which
  // was drawn all the while. Fails, and changes nothing, when a shader does not compile.
  Result<void> setDebugView(DebugView view);
  DebugView debugView() const;
  std::vector<float> debugValues() const;  // of the last picture, rows from the top; below 0: a pixel has none. Empty: nothing was drawn
  // Draws this view from the tree as it is now, without history; no edit is applied; history, frame count and metered exposure
  // stay. For comparing: image() and radiance() then return this picture. What its rays met is counted.
  FrameCounters preview(const View& view);
  // The same for some pixels only (x, y from the top left), every one marched; the others show what was there before.
  Result<FrameCounters> preview(const View& view, std::span<const glm::ivec2> pixels);
  // All is drawn in the frame in which the clouds rest: the planet's, turned by their mean wind until now. A view, and where the sun stands, there.
  View inClouds(const View& view) const;
  glm::dvec3 sunInClouds() const;
  // For the reference (docs/reference.md), in that frame: the view's rays, the tree as preview(view) would see it (clouds only), and
  // preview() with what each pixel's ray through the clouds brings given, width * height from the top row, instead of marched.
  shared::CameraBlock camera(const View& view) const;
  TreeData tree(const View& view);
  Result<void> drawWith(const View& view, std::span<const shared::CloudWeights> clouds);
  Image8 image() const;
  const gpu::Texture& shown() const;  // the same on the GPU, top row first; another one after resize()
  ImageF radiance() const;  // without pixels if nobody was to read it (RenderSettings::linear)
  double drawnDetail(const View& view) const;  // nodes a radian that the tree has for this view, or shownDetail if less
  double shownDetail(const View& view) const;  // nodes a radian past which voxels are finer than this view's pixels
  const FramePlan& plan() const;  // of all frames; FrameStats::leftOut says what one frame does without
  const Scene& scene() const;
  const gpu::MemoryAccount& memory() const;
  std::vector<std::string> notes() const;  // one line each: what a user should know (data that was missing, ...)

 private:
  Renderer();
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The least budget that works for this scene, in bytes: made by building everything but the tree (docs/memory.md).
Result<std::uint64_t> leastBudget(gpu::Context& context, const Scene& scene);

}  // namespace welkin
