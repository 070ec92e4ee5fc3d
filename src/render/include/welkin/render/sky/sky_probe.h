#pragma once
// Radiance along single rays by the sky's tables on the GPU: what pictures are made of, without the tables of a view.
#include <span>
#include <vector>

#include "welkin/render/sky/sky_tables.h"

namespace welkin {

// A ray from an observer: metres, radians. Zenith angles at the observer; azimuth from the sun's.
struct SkyRay {
  double altitude_m = 0, sunZenith_rad = 0, viewZenith_rad = 0, azimuth_rad = 0;
  double maxDistance_m = 0;  // infinity: to the ground or out of the air
};
struct SkyAnswer {
  Spectrum3 radiance{0, 0, 0};       // for a sun of irradiance 1, 1/sr
  Spectrum3 transmittance{1, 1, 1};  // to the ray's end
};

// Altitudes below 0 count as 0. Fails in one line: memory, shader.
Result<std::vector<SkyAnswer>> probeSky(gpu::MemoryAccount& account, SkyTables& tables, const Scene& scene, std::span<const SkyRay> rays);

}  // namespace welkin
