#pragma once
// Where buffers and textures are bound: one table for all passes.
#include "welkin/shared/prelude.glsl.h"
// Macros, because GLSL 4.50 layout qualifiers take them and C++ reads them as numbers.
// storage buffers
#define WK_NODES_BINDING 0
#define WK_SOURCE_PARAMS_BINDING 1
#define WK_BRICK_JOBS_BINDING 2
#define WK_BRICK_RESULTS_BINDING 3
#define WK_COUNTERS_BINDING 4
#define WK_CHORDS_BINDING 3         // of light, which has no results
#define WK_MAP_JOBS_BINDING 5
#define WK_EXPOSURE_BINDING 5      // after the maps, which bind their jobs anew each time: GL promises eight, 0 to 7
#define WK_PIXELS_BINDING 6
#define WK_AIR_PARAMS_BINDING 7
// uniform buffers
#define WK_CAMERA_BINDING 0
// texture units
#define WK_BRICK_UNIT 0            // 0..7: brick textures
#define WK_TREE_UNIT 8             // octree maps and nodes, buffer texture, RG32UI (tree_block.glsl.h: mapEntry)
#define WK_CHORDS_UNIT 20          // clouds' chords at corners of bricks, buffer texture, RGBA32UI, two texels a brick (lib/tree.glsl)
#define WK_COVER_UNIT 9            // cover, 2-D array of 6 faces, R16
#define WK_SKY_TRANSMITTANCE_UNIT 10
#define WK_SKY_IRRADIANCE_UNIT 11
#define WK_SKY_VIEW_SCATTER_UNIT 12
#define WK_SKY_VIEW_TRANSMITTANCE_UNIT 13
#define WK_CLOUD_LIGHT_UNIT 14     // RGBA16F: cloud radiance towards the camera without the air between; a: cloud transmittance
#define WK_CLOUD_AUX_UNIT 15       // RG32F: transmittance-weighted cloud distance [m]; sun visibility of the ground point, 0..1
#define WK_ALBEDO_UNIT 16
#define WK_CLOUD_CHANGE_UNIT 17    // RGBA16F, a texel for 4 x 4 pixels: what the marched one differs from its history
#define WK_CLOUD_AGE_UNIT 18       // R8UI: frames since a pixel's cloud was marched
#define WK_SKY_FIELD_UNIT 19       // diffuse light, 2-D array, a layer a moment (lib/air_field.glsl)
