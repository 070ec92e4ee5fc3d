#pragma once
// The words that a layered cloud source hands to the GPU, in order: CloudHeader, kMaxCloudLayers times CloudLayerParams, cover
// bytes. Scalars and arrays of scalars only, so std430 and C++ agree. C++ functions get a SourceView, GLSL reads the buffer.
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/octree.glsl.h"
WK_BEGIN

WK_CONST uint kMaxCloudLayers = 12u;
WK_CONST uint kCoverMips = 8u;
WK_CONST uint kThresholdSteps = 16u;

struct CloudHeader {
  uint layerCount;
  uint coverMips;        // 0: no cover map, cover is 1 everywhere
  uint typeShift;        // cells of the weather type's first octave: 2^typeShift steps
  uint seed;
  float step_m;          // metres a step
  float radius_steps;    // planet radius in steps, rounded
  uint radius2Low;       // its square as a double, low and high word
  uint radius2High;
  float lowest_m;        // lowest base and highest top of all layers
  float highest_m;
  float footprint_m[25]; // voxel edge by level
  uint coverMip[25];     // mip by level
  uint coverEdge[8];     // texels an axis of a mip's face, border not counted
  uint coverOffset[8];   // first word of a mip
};

struct CloudLayerParams {
  float base_m;
  float thickness_m;
  float invThickness;
  float baseFade_m;
  float invBaseFade;
  float topFade_m;
  float invTopFade;
  float extinction_per_m;
  float coverGain;
  float coverBias;
  float typeLow;         // weight (t - low) * invRise and (high - t) * invRise, clamped, the smaller
  float typeHigh;
  float typeInvRiseLow;
  float typeInvRiseHigh;
  uint typed;            // 0: any weather type
  uint shift;            // cells of octave 0: 2^shift steps along x and y,
  uint streak;           // 2^(shift - streak) along z
  uint seed;
  float amplitude;       // of octave 0; all octaves add up to 1
  float gain;
  float billow;
  float restHigh;        // greatest value of an octave of amplitude 1 (1 for plain noise)
  float invSoftness;
  float taper;
  float topFollowsCover;
  uint warpShift;
  float warp_steps;      // 0: no warp
  float threshold[17];   // noise that is exceeded with probability i / 16
  uint octaves[25];      // by level
  float shown[25];       // by level: sum of the amplitudes of its octaves
  float spread[25];      // by level: half width of what the level cannot show, in units of softness
  float invSpread2[25];  // 1 / (6 spread^2), 0 if spread is 0
  float clump[25];       // by level: optical depth of a clump times the share of the noise that is not shown
  float filter_m[25];    // by level: height over which the profile is averaged; 0: taken at the point
  float blur_m[25];      // by level: height over which that mean is averaged once more; 0: it is not
};
WK_END

#ifdef __cplusplus
#include <cstddef>
namespace welkin::shared {
struct CloudBlock {
  CloudHeader header;
  CloudLayerParams layers[kMaxCloudLayers];
};
static_assert(sizeof(CloudBlock) % 4 == 0);
struct SourceView {
  const CloudBlock* block;
  const uint* cover;
};
inline double doubleFromWords(uint low, uint high) {
  const std::uint64_t bits = (std::uint64_t{high} << 32) | low;
  double x;
  __builtin_memcpy(&x, &bits, 8);
  return x;
}
}  // namespace welkin::shared
#define WK_SOURCE_PARAM const SourceView &sourceView,
#define WK_SOURCE_ARG sourceView,
#define WK_HEADER sourceView.block->header
#define WK_LAYER(i) sourceView.block->layers[i]
#define WK_COVER_WORD(i) sourceView.cover[i]
#else
layout(std430, binding = WK_SOURCE_PARAMS_BINDING) readonly buffer SourceParams {
  CloudHeader sourceHeader;
  CloudLayerParams sourceLayers[12];
  uint sourceCover[];
};
double doubleFromWords(uint low, uint high) { return packDouble2x32(uvec2(low, high)); }
#define WK_SOURCE_PARAM
#define WK_SOURCE_ARG
#define WK_HEADER sourceHeader
#define WK_LAYER(i) sourceLayers[i]
#define WK_COVER_WORD(i) sourceCover[i]
#endif
