#pragma once
// Puts the picture together: ground, sun, air and the cloud layer to one picture, in linear radiance and tone-mapped.
#include <cstdint>
#include <optional>
#include <vector>

#include "welkin/core/result.h"
#include "welkin/gpu/memory.h"
#include "welkin/gpu/program.h"
#include "welkin/gpu/resources.h"
#include "welkin/physics/scene.h"
#include "welkin/shared/camera.glsl.h"

namespace welkin {

// Equirectangular picture of the ground: sRGB, RGBA, top row north, longitude 0 in the middle.
struct AlbedoPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

struct FramePlan;

// What a picture is put together from, and what is kept of it.
struct CompositeParts {
  bool clouds, air, sun, ground = true;
  bool linear = true;   // radiance()
  bool display = true;  // tone-maps too; else ExposurePass::show does
  explicit CompositeParts(const Scene& scene);
  explicit CompositeParts(const FramePlan& plan);
};

class CompositePass {
 public:
  // A picture of the ground is halved until it takes a sixteenth of the budget: whether this size does, and its bytes with all mips.
  static bool albedoFits(int width, int height, std::uint64_t budget);
  static std::uint64_t albedoBytes(int width, int height);
  // Fails in one line: over the budget, or a shader that does not compile. What the scene has not is not compiled. The picture is halved
  // until it is at most 2048 wide and, with its smaller copies, at most 1/16 of the budget.
  static Result<CompositePass> create(gpu::MemoryAccount& account, const Scene& scene, const CompositeParts& parts, int width, int height,
                                      const AlbedoPicture* albedo = nullptr);
  static Result<CompositePass> create(gpu::MemoryAccount& account, const Scene& scene, int width, int height,
                                      const AlbedoPicture* albedo = nullptr) {
    return create(account, scene, CompositeParts(scene), width, height, albedo);
  }
  ~CompositePass();
  CompositePass(CompositePass&& o) noexcept { swap(o); }
  CompositePass& operator=(CompositePass&& o) noexcept {
    swap(o);
    return *this;
  }

  Result<void> resize(int width, int height);  // new, empty pictures
  Result<void> useOutput(const CompositeParts& parts, ToneCurve curve);  // clouds, air, sun and ground as before
  // Plain albedo and sun of this scene from now on; what it has and has not stays as it was at the start. wind_rad: how far the picture is
  // turned eastwards against the ground.
  void use(const Scene& scene, double wind_rad = 0);

  // Reads the camera (WK_CAMERA_BINDING, the same block as here), the sky tables (SkyTables::bind) and the cloud layer's two textures;
  // counts into WK_COUNTERS_BINDING. Exposure in EV: 0 suits a sun of irradiance 1; of a scene with a metered exposure it is not used,
  // and display() is left to ExposurePass::show.
  void run(const shared::CameraBlock& camera, double exposure_ev) const { run(program_, camera, exposure_ev); }
  // The same without air, clouds and picture of the ground. prepareBare() compiles it, once.
  Result<void> prepareBare();
  void runBare(const shared::CameraBlock& camera, double exposure_ev) const { run(bare_, camera, exposure_ev); }
  // The same picture for a debug view (`debug` defines which), with or without clouds, tone-mapped. It writes a number for each pixel
  // (R32F) and colours (RGBA8), and leaves radiance() and display() alone.
  Result<gpu::Program> compileAside(bool clouds, const gpu::Defines& debug) const;
  void runAside(const gpu::Program& program, const shared::CameraBlock& camera, double exposure_ev, const gpu::Texture& values,
                const gpu::Texture& colours) const;

  const gpu::Texture& radiance() const { return radiance_; }  // RGBA32F, linear, before exposure; a = 1 - cloud transmittance; if kept
  const gpu::Texture& display() const { return display_; }    // RGBA8, sRGB values

 private:
  CompositePass() = default;
  void swap(CompositePass& o) noexcept;
  void run(const gpu::Program& program, const shared::CameraBlock& camera, double exposure_ev) const;
  void dispatch(const gpu::Program& program, const shared::CameraBlock& camera, double exposure_ev) const;  // images are bound
  Result<void> loadAlbedo(gpu::MemoryAccount& account, AlbedoPicture picture);

  gpu::Program program_, bare_;
  gpu::Texture radiance_, display_;
  int width_ = 0, height_ = 0;
  glm::vec3 albedo_{}, toSun_{}, sunIrradiance_{};
  float sunRadius_rad_ = 0, groundTurn_ = 0;
  std::optional<CompositeParts> parts_;
  ToneCurve toneCurve_{};
  GLuint albedoMap_ = 0;  // with smaller copies, which gpu::Texture has not
  std::uint64_t albedoBytes_ = 0;
  gpu::MemoryAccount* account_ = nullptr;
};

}  // namespace welkin
