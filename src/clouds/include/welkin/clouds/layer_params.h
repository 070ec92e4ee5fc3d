#pragma once
// From a layer in metres to the numbers that the density functions read.
#include "welkin/physics/root_frame.h"
#include "welkin/physics/scene.h"
#include "welkin/shared/cloud_source.glsl.h"

namespace welkin {

// Noise of this layer in units of its own amplitude, all octaves, at a fixed-point position (no warp).
float layerNoise(const shared::CloudLayerParams& layer, glm::uvec3 p, std::uint32_t octaves);

shared::CloudLayerParams makeLayerParams(const CloudLayer& layer, const RootFrame& root, std::uint32_t seed);

// Header for `layers`, without a cover map.
shared::CloudHeader makeCloudHeader(const RootFrame& root, std::uint32_t seed, std::uint32_t layerCount);

}  // namespace welkin
