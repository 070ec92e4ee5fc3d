#pragma once
// Radiance along single rays by the sky's tables on the GPU: what pictures are made of, without the tables of a view.
#include <span>
#include <vector>

#include "welkin/physics/probe.h"
#include "welkin/render/sky/sky_tables.h"

namespace welkin {

// Altitudes below 0 count as 0. Fails in one line: memory, shader.
Result<std::vector<ProbeResult>> probeSky(gpu::MemoryAccount& account, SkyTables& tables, const Scene& scene, std::span<const ProbeRay> rays);

}  // namespace welkin
