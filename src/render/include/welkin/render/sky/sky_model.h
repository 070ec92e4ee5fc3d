#pragma once
// How much of the sky is tabulated, by name. All models share the passes; they differ in numbers.
#include <cstdint>
#include <string>

#include "welkin/core/result.h"
#include "welkin/physics/scene.h"

namespace welkin {

struct SkyModel {
  std::string name;                    // tables-4d, tables-2d, march
  std::string reason;                  // why this one
  int degree = 0, zonal = 0;           // of the harmonics of the diffuse light (lib/air_field.glsl)
  std::uint32_t sunTexels = 0, altitudeTexels = 0;  // of the field's table
  int above = 0, below = 0, azimuths = 0;           // directions gathered about the vertical
  int peakAngles = 0, peakAzimuths = 0;             // about the sun, for each peaked layer
  int pieces = 0;                      // of each path gathered, two nodes each
  int maxOrders = 0;                   // of scattering; 1: no field
  double rest = 0;                     // stop when what is missing is below this part of the light

  int moments() const { return (degree + 1) * (degree + 2) / 2 + zonal - degree; }
  bool diffuse() const { return maxOrders > 1; }
};

// The model that the scene's `atmosphere.model` names. `auto`: tables-4d, or march where the air is too thin for more. Fails in one line
// on air that is none (airBlock) and on a name that is none.
// everyHarmonic: tabulated as for peaked layers even if there is none.
Result<SkyModel> skyModel(const Scene& scene, bool everyHarmonic = false);

}  // namespace welkin
