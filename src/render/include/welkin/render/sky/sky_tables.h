#pragma once
// The air's tables on the GPU. Once per scene: optical depth to the top, multiple scattering, sky irradiance. Per view: in-scatter and
// optical depth along every ray from the camera (lib/air.glsl reads them).

#include "welkin/core/result.h"
#include "welkin/gpu/memory.h"
#include "welkin/gpu/program.h"
#include "welkin/gpu/resources.h"
#include "welkin/physics/scene.h"
#include "welkin/shared/air.glsl.h"
#include "welkin/shared/camera.glsl.h"

namespace welkin {

class SkyTables {
 public:
  // Computes the tables that depend on the scene alone. Fails in one line: no atmosphere, values out of range, over the budget.
  static Result<SkyTables> create(gpu::MemoryAccount& account, const Scene& scene);

  // Makes the view tables fit this camera. They depend on the camera's altitude and the sun's zenith angle only, and both are rounded
  // to steps too small to see, so the tables are a function of the pose, not of the flight before it:
  //  altitude 1/1000 of the thinnest exponential layer's scale height, or 1/2000 of the altitude if that is more. Radiance changes by
  //  at most about its own 1/1000 a step there, a quarter of 1/255;
  //  zenith cosine 2^-15: 0.0017 degrees. Twilight, the fastest change, fades by a factor e in about 1.5 degrees: 1/1000 again.
  // `toSun`: unit, planet frame. Returns whether the tables were computed anew.
  bool updateView(const shared::CameraBlock& camera, glm::dvec3 toSun);

  // Textures to their units, parameters to WK_AIR_PARAMS_BINDING as uniform buffer (AirBlock) and as storage buffer.
  void bind() const;
  const gpu::Texture& multiple() const { return multiple_; }
  const shared::AirBlock& block() const { return block_; }
  std::size_t bytes() const;

 private:
  Result<void> allocate(gpu::MemoryAccount& account);
  Result<void> compute();  // all tables of the scene, and the program of the view tables

  shared::AirBlock block_{};
  double altitudeStep_m_ = 1;
  double keyAltitude_m_ = -1, keyCosSun_ = 2;
  gpu::Buffer params_;
  gpu::Texture transmittance_, multiple_, irradiance_, scatter_, depth_;
  gpu::Program viewProgram_;
};

}  // namespace welkin
