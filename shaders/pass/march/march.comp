// Marches the clouds of a set of pixels: all of them or every second or fourth of a row and column, one in 16 of a frame, or those of a list.
#include "lib/cloud_march.glsl"
#include "lib/shadow.glsl"
#include "lib/tile_pixel.glsl"
#include "welkin/shared/counters.glsl.h"
#if OPT_AIR
#include "lib/air.glsl"
layout(binding = WK_SKY_TRANSMITTANCE_UNIT) uniform sampler2D u_skyTransmittance;
layout(binding = WK_SKY_IRRADIANCE_UNIT) uniform sampler2D u_skyIrradiance;
layout(std140, binding = WK_AIR_PARAMS_BINDING) uniform AirUniforms { AirBlock u_air; };
#define air u_air.params
#endif

#define PIXELS_ALL 0
#define PIXELS_SIXTEENTH 1
#define PIXELS_LIST 2
#define PIXELS_GIVEN 3  // all, and not marched: what the rays bring is given
#if PIXELS == PIXELS_LIST
layout(local_size_x = 64) in;
#else
layout(local_size_x = 8, local_size_y = 8) in;
#endif
layout(std140, binding = WK_CAMERA_BINDING) uniform CameraUniforms { CameraBlock camera; };
layout(std430, binding = WK_COUNTERS_BINDING) buffer CounterBuffer { Counters counters; };
layout(rgba16f, binding = 0) uniform writeonly image2D u_light;
#if OPT_AUX
layout(rg32f, binding = 1) uniform writeonly image2D u_aux;
#endif
#if OPT_HISTORY
layout(r8ui, binding = 3) uniform writeonly uimage2D u_age;
#endif
#if PIXELS == PIXELS_SIXTEENTH
#include "lib/reproject.glsl"
layout(rgba16f, binding = 2) uniform writeonly image2D u_change;
#endif
#if PIXELS == PIXELS_LIST
layout(std430, binding = WK_PIXELS_BINDING) readonly buffer PixelList { uint groups, one, one_, count, pixels[]; };
#endif
#if PIXELS == PIXELS_GIVEN
layout(std430, binding = WK_PIXELS_BINDING) readonly buffer GivenClouds { CloudWeights given[]; };
#endif
uniform ivec2 u_size;
uniform ivec2 u_offset;   // which pixel of each 4 x 4
uniform int u_spacing;    // of PIXELS_ALL
uniform vec3 u_sunIrradiance;
uniform float u_groundAlbedo;  // where no table has the ground's light; else 0

const float kBrightest = 65504.0;  // of a half float, which the history is made of; past it is infinity

struct CloudColours { vec3 sun, sky, ground; };

// Irradiances that light a cloud at this point: of the sun through the air, of sky and ground. Where coarse voxels carry it above its
// source's top it is lit as at the top: else it would shine red far into the night.
CloudColours coloursAt(dvec3 position) {
  float r = float(length(position));
  float altitude = clamp(float(length(position) - double(tree.planetRadius_m)), 0.0, tree.cloudTop_m);
  float muSun = dot(vec3(position), tree.sunDir.xyz) / r;
  vec3 ground = max(muSun, 0.0) * u_groundAlbedo * u_sunIrradiance;
#if OPT_AIR
  AirLight sky = airSkyIrradiance(u_skyIrradiance, air, altitude, muSun);
  return CloudColours(airSunTransmittance(u_skyTransmittance, air, altitude, muSun) * u_sunIrradiance, sky.fromAbove, sky.fromBelow + ground);
#else
  float dip = sqrt(altitude * (2.0 * tree.planetRadius_m + altitude)) / r;  // sine of the horizon's dip
  float lit = muSun > -dip ? 1.0 : 0.0;
  return CloudColours(lit * u_sunIrradiance, vec3(0.0), ground);
#endif
}

void main() {
#if PIXELS == PIXELS_LIST
  if (gl_GlobalInvocationID.x >= count) return;
  uint entry = pixels[gl_GlobalInvocationID.x];
  ivec2 pixel = ivec2(entry & 0xFFFFu, entry >> 16u);
#elif PIXELS == PIXELS_SIXTEENTH
  ivec2 pixel = tilePixel() * 4 + u_offset;
  if (any(greaterThanEqual(pixel, u_size))) imageStore(u_change, pixel / 4, vec4(0.0));  // a tile cut by the border; beyond the image nothing is stored
#elif PIXELS == PIXELS_ALL
  ivec2 pixel = tilePixel() * u_spacing;
#else
  ivec2 pixel = tilePixel();
#endif
  if (any(greaterThanEqual(pixel, u_size))) return;
  vec2 ndc = vec2(2.0 * (float(pixel.x) + 0.5) / float(u_size.x) - 1.0, 1.0 - 2.0 * (float(pixel.y) + 0.5) / float(u_size.y));
  Ray view = cameraRay(camera, ndc);
  dvec3 position = xyz(camera.position);
  CloudPhases phases = cloudPhases(dot(view.dir, tree.sunDir.xyz));
#if PIXELS == PIXELS_GIVEN
  CloudWeights weights = given[pixel.y * u_size.x + pixel.x];
  CloudRay cloud = CloudRay(weights.sun, weights.sky, weights.ground, weights.transmittance, weights.distance_m, 0u, 0u, false);
#else
  CloudRay cloud = marchClouds(position, camera.position.w, camera.up.w, camera.forward.w, view.dir, view.ground_m, phases);
#endif
  vec3 light = vec3(0.0);
  if (cloud.transmittance < 1.0) {
    CloudColours colours = coloursAt(position + dvec3(view.dir) * double(cloud.distance_m));
    light = cloud.sun * colours.sun + cloud.sky * colours.sky + cloud.ground * colours.ground;
    light = mix(min(light, vec3(kBrightest)), light, isnan(light));  // of a comparison compilers make min(), which loses a NaN
  }
  float shadow = 1.0;
#if OPT_GROUND
  if (view.ground_m >= 0.0 && cloud.transmittance > 0.0 && tree.sunDir.w > 0.0)
    shadow = cloudShadow(sunDepth(position + dvec3(view.dir) * double(view.ground_m), 0.0));
#endif
  imageStore(u_light, pixel, vec4(light, cloud.transmittance));
#if OPT_AUX
  imageStore(u_aux, pixel, vec4(cloud.distance_m, shadow, 0.0, 0.0));
#endif
#if OPT_HISTORY
  imageStore(u_age, pixel, uvec4(0u));
#endif
#if PIXELS == PIXELS_SIXTEENTH
  History history = findHistory(pixel, view.dir, u_size);
  history.still = history.still || !history.valid;  // without history: against what was here, so that a great change is noticed
  imageStore(u_change, pixel / 4, vec4(light, cloud.transmittance) - historyLight(history, pixel, u_size));
#endif
  atomicAdd(counters.marchedPixels, 1u);
  atomicAdd(counters.cells, cloud.cells);
  atomicAdd(counters.samples, cloud.samples);
  if (cloud.hole) atomicAdd(counters.holes, 1u);
}
