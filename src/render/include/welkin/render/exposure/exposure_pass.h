#pragma once
// Metered exposure: a histogram of the linear picture, adaptation in time, and the picture shown at what was reached. The state stays
// on the GPU: nothing is read back within a frame.
#include <optional>

#include "welkin/core/result.h"
#include "welkin/gpu/memory.h"
#include "welkin/gpu/program.h"
#include "welkin/gpu/resources.h"
#include "welkin/physics/scene.h"

namespace welkin {

// kBaseExposure 2^ev, rounded once: what every pass multiplies radiance by.
float exposureScale(double ev);

class ExposurePass {
 public:
  // Fails in one line: over the budget, or a shader that does not compile.
  static Result<ExposurePass> create(gpu::MemoryAccount& account, const Scene& scene);

  // Meters `radiance` (RGBA32F, linear) and moves the exposure towards what it asks for. sinceLast_s: scene time since the picture
  // before, at least 0; infinite: all the way. The first picture with any light in it is adapted to fully.
  void meter(const gpu::Texture& radiance, double sinceLast_s);
  // Tone-maps `radiance` into `display` (RGBA8, of the same size) at the metered exposure, or at ev.
  void show(const gpu::Texture& radiance, const gpu::Texture& display, std::optional<double> ev = {}) const;

  bool metered() const { return metered_; }            // has any picture been metered?
  double reached_ev() const;                           // reads back: waits for the GPU
  const gpu::Buffer& block() const { return block_; }  // ExposureBlock; its bins are empty between pictures

 private:
  ExposurePass() = default;
  gpu::Program histogram_, adapt_, show_;
  gpu::Buffer block_;
  AutoExposure settings_;
  float unitInverse_ = 1, offset_ev_ = 0;
  bool metered_ = false;
};

}  // namespace welkin
