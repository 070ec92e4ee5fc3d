#pragma once
// What every pass that reads the octree knows of it: one std140 uniform block at WK_TREE_BINDING.
#include "welkin/shared/octree.glsl.h"
#include "welkin/shared/sun_depth.glsl.h"
#define WK_TREE_BINDING 1
WK_BEGIN

// One brick to generate or to light (std430, 32 bytes).
struct GpuBrickJob {
  uint x, y, z;   // corner
  uint level;
  uint brick;
  uint spare0, spare1, spare2;
};

// What generation found (std430). Floats as bits: order of non-negative floats is the order of their bits, so integer atomics serve.
struct GpuBrickResult {
  uint minBits;          // least and greatest stored value, as a fraction of the source's maximum
  uint maxBits;
  uint minAltitudeBits;  // of non-zero samples, altitude + kAltitudeBias, metres
  uint maxAltitudeBits;
};
WK_CONST float kAltitudeBias = F(1048576.0);  // 2^20 m: keeps altitudes positive, and to 0.125 m, as floats; lower is clamped
WK_CONST uint kAltitudeNoneMin = 0x7F800000u;

struct TreeBlock {
  double half_m;            // half of the root's edge
  double stepsPerMetre;
  vec4 sunDir;              // planet frame; w: 1 if the scene has a sun
  vec4 mapCentre;           // planet frame, m: where the octree maps are placed around, the camera
  float stepLength_m;       // of one fixed-point step
  float rootSize_m;
  float detail;             // K: level L is sampled up to K * nodeSize(L) away
  float maxExtinction_per_m;
  float bandBase_m, bandTop_m;
  float planetRadius_m;
  float step;               // length of a march segment, in units of its rule (step_rules.glsl.h)
  uint depth;
  uint mapBase;             // coarsest octree map's level: its 64^3 cells or fewer cover the root
  float atlasDepthInverse;  // 1 / texels along z of a brick texture
  uint firstNode;           // where the nodes start in the tree's buffer
  float cloudTop_m;         // the source's: stored cloud reaches higher by some voxels
  float shadowTop_m;        // where shadow rays end: the source's top, or the band's if higher
  float sampleNear_m;       // nearer than this the level of detail is that of this distance: finer data may not be there yet
  uint bricksPerTexture;
  float pixelDetail;        // K at which a node's voxels are as small as a pixel shows
};

// One buffer of node words: the octree maps, coarsest first, each 64^3 cells with x fastest and addressed modulo 64; then the nodes.
WK_CONST uint kMapCells = 262144u;
WK_FN uint mapEntry(uvec3 cell, uint level, uint mapBase) {
  return (level - mapBase) * kMapCells + ((cell.x & 63u) | ((cell.y & 63u) << 6u) | ((cell.z & 63u) << 12u));
}
WK_FN uint firstNode(uint mapBase, uint depth) { return (depth - mapBase + 1u) * kMapCells; }

// Brick textures: 4 x 256 bricks a layer, at most 256 layers (512 MiB of RG16) a texture. Narrow, because software GL keeps a texture row
// by row: a brick's slice then lies within 1 KiB instead of 16.
WK_CONST uint kAtlasX = 4u;
WK_CONST uint kAtlasY = 256u;
WK_CONST uint kAtlasLayers = 256u;
WK_CONST uint kBricksPerLayer = 1024u;

// First texel of a brick, counted within its texture.
WK_FN uvec3 brickTexel(uint brickInTexture) {
  return uvec3(brickInTexture & 3u, (brickInTexture >> 2u) & 255u, brickInTexture >> 10u) * 8u;
}

// Which level a ray samples at distance d [m], and how much of its parent is mixed in: floor and fraction of log2(K root / d).
// In the last eighth of the level's reach, which is the top quarter of its range, the parent fades in (DESIGN, level of detail).
struct DetailLevel {
  uint level;
  float parentWeight;
};
WK_CONST float kFadeStart = F(0.875);
WK_FN DetailLevel detailAt(float reach, uint depth) {  // reach = K * rootSize / d
  uint bits = floatBitsToUint(max(reach, F(1.0)));
  uint level = (bits >> 23u) - 127u;
  if (level >= depth) {
    // Beyond the deepest level's own range there is nothing finer to fade from.
    float r = max(reach, F(1.0)) * uintBitsToFloat((127u - min(depth, 126u)) << 23u);  // reach / 2^depth
    return WK_NEW(DetailLevel, depth, depth == 0u ? F(0.0) : clamp((F(1.0) - kFadeStart * r) / (F(1.0) - kFadeStart), F(0.0), F(1.0)));
  }
  float r = uintBitsToFloat((bits & 0x007FFFFFu) | 0x3F800000u);  // 1..2: 1 at the far end of the range
  return WK_NEW(DetailLevel, level, level == 0u ? F(0.0) : clamp((F(1.0) - kFadeStart * r) / (F(1.0) - kFadeStart), F(0.0), F(1.0)));
}

// The finest octree map that surely covers a point at distance d: the maps' windows reach at least kMapReach cells from the camera.
WK_CONST float kMapReach = F(30.0);
WK_FN uint mapLevelAt(float rootOverDistance, uint mapBase, uint depth) {
  uint bits = floatBitsToUint(max(kMapReach * rootOverDistance, F(1.0)));
  return clamp((bits >> 23u) - 127u, mapBase, depth);
}

WK_END
