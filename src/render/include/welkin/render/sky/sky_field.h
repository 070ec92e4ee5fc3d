#pragma once
// The field of diffuse light (lib/air_field.glsl): what every point sees (gather) and its moments (project), which are the source of light
// scattered once more. Each turn adds an order; the limit is extrapolated.
#include <string>
#include <vector>

#include "welkin/gpu/memory.h"
#include "welkin/gpu/program.h"
#include "welkin/gpu/resources.h"
#include "welkin/render/sky/sky_model.h"
#include "welkin/shared/air.glsl.h"

namespace welkin {

class SkyField {
 public:
  // `defines`: of the scene's layers. The air block and the sun's depth must be bound when advance() runs.
  static Result<SkyField> create(gpu::MemoryAccount& account, const SkyModel& model, const shared::AirBlock& air, const gpu::Defines& defines);

  // One slice of the work: some altitudes of one order, with the last of them its end. False when all is done. After each order the tables
  // hold the light so far.
  bool advance(int rows);
  double progress() const;  // 0..1, by the greatest number of orders

  void letGoOfMakers();  // once advance() has answered false: only the tables stay
  void bind() const;     // field and irradiance to their units
  const gpu::Texture& irradiance() const { return irradiance_; }
  bool kept() const { return kept_; }     // it was on disk (sky_cache.h)
  int orders() const { return orders_; }  // gathered so far
  double rest() const { return rest_; }   // estimate of what is missing, relative to the light, greatest of the three wavelengths
  std::size_t bytes() const;

 private:
  using Moments = std::vector<glm::vec4>;
  std::size_t points() const { return std::size_t(model_.sunTexels) * model_.altitudeTexels; }
  void gatherRows(int rows);
  void endOrder();
  void store(const Moments& moments);
  Moments extrapolate();  // of the steps; sets rest_

  SkyModel model_;
  int aboutVertical_ = 0, directions_ = 0, row_ = 0;
  bool done_ = false, kept_ = false;
  std::string key_;
  double rest_ = 1;
  int orders_ = 0;
  struct Step { Moments change, to; };
  std::vector<Step> steps_;
  Moments first_, light_;  // first order; light that the table holds
  gpu::Buffer directionList_, radiance_, moments_;
  gpu::Texture field_, irradiance_;
  gpu::Program firstProgram_, nextProgram_, project_, store_;
};

}  // namespace welkin
