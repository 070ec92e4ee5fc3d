#pragma once
// The air's tables on the GPU. Once per scene: the sun's light everywhere and the field of diffuse light (sky_model.h). Per view:
// in-scatter and optical depth along every ray from the camera (lib/air.glsl reads them).
#include <memory>

#include "welkin/core/result.h"
#include "welkin/gpu/memory.h"
#include "welkin/gpu/program.h"
#include "welkin/gpu/resources.h"
#include "welkin/physics/scene.h"
#include "welkin/render/sky/sky_model.h"
#include "welkin/shared/air.glsl.h"
#include "welkin/shared/camera.glsl.h"

namespace welkin {

class SkyField;

enum class SkyOrders { First, All };  // of scattering; First: extinction is physical throughout

class SkyTables {
 public:
  SkyTables(SkyTables&&) noexcept;
  SkyTables& operator=(SkyTables&&) noexcept;
  ~SkyTables();

  // Computes the tables that depend on the scene alone. Fails in one line: no atmosphere, values out of range, over the budget.
  static Result<SkyTables> create(gpu::MemoryAccount& account, const Scene& scene, SkyOrders orders = SkyOrders::All, bool everyHarmonic = false);

  // The same in slices: begin() makes the sun's light, each advance() so many altitudes of one order, until it answers false. In
  // between the tables hold the light of the orders so far.
  static Result<SkyTables> begin(gpu::MemoryAccount& account, const Scene& scene, SkyOrders orders = SkyOrders::All, bool everyHarmonic = false);
  bool advance(int rows);
  double progress() const;  // 0..1
  // Once all is made: what it was made with goes. advance() may not be called any more.
  void letGoOfMakers();

  // Tables of a changed scene with the diffuse light of `from`, which is not usable any more: at once, but light scattered more than once
  // is still that of the old air. Fails in one line if the old light does not fit the new tables; `from` is then as it was.
  static Result<SkyTables> withField(gpu::MemoryAccount& account, const Scene& scene, SkyTables& from, bool everyHarmonic = false);

  // Makes the view tables fit this camera. They depend on the camera's altitude and the sun's zenith angle only, and both are rounded
  // to steps too small to see, so the tables are a function of the pose, not of the flight before it:
  //  altitude 1/1000 of the thinnest exponential layer's scale height, or 1/2000 of the altitude if that is more. Radiance changes by
  //  at most about its own 1/1000 a step there, a quarter of 1/255;
  //  zenith cosine 2^-15: 0.0017 degrees. Twilight, the fastest change, fades by a factor e in about 1.5 degrees: 1/1000 again.
  // `toSun`: unit, planet frame. Returns whether the tables were computed anew.
  bool updateView(const shared::CameraBlock& camera, glm::dvec3 toSun);

  // Textures to their units, parameters to WK_AIR_PARAMS_BINDING as uniform buffer (AirBlock) and as storage buffer.
  void bind() const;
  const shared::AirBlock& block() const { return block_; }
  const SkyModel& model() const { return model_; }
  const SkyField& field() const { return *field_; }
  gpu::Defines drawDefines() const;  // of passes that follow light along paths (lib/air_path.glsl)
  std::size_t bytes() const;

 private:
  SkyTables();
  static Result<SkyTables> empty(gpu::MemoryAccount& account, const Scene& scene, SkyOrders orders, bool everyHarmonic);  // all but the field
  Result<void> allocate(gpu::MemoryAccount& account);
  Result<void> compute();  // the sun's light, and the program of the view tables
  const gpu::Texture& sunDepth() const { return discDepth_.id() != 0 ? discDepth_ : pointDepth_; }

  SkyModel model_;
  shared::AirBlock block_{};
  double altitudeStep_m_ = 1;
  double keyAltitude_m_ = -1, keyCosSun_ = 2;
  gpu::Defines defines_;
  gpu::Buffer params_;
  gpu::Texture pointDepth_, discDepth_, diffuse_, scatter_, depth_;
  std::unique_ptr<SkyField> field_;
  gpu::Program viewProgram_, diffuseProgram_;
};

}  // namespace welkin
