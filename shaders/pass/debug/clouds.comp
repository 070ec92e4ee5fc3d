// How the rays of the march went (docs/debug-views.md): every pixel is marched, and of each ray that is kept which DEBUG_VIEW asks for.
#include "welkin/shared/cloud_light.glsl.h"
#include "welkin/shared/debug.glsl.h"
#if DEBUG_VIEW == WK_DEBUG_LIGHT
// In place of the light itself the share of the sun's that arrives unscattered: the ray then sums its mean over what is seen.
#define sunSource(phases, tau, slab) exp(-(tau))
#endif
#include "lib/cloud_march.glsl"
#include "lib/shadow.glsl"
#include "lib/tile_pixel.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = WK_CAMERA_BINDING) uniform CameraUniforms { CameraBlock camera; };
layout(r32f, binding = 0) uniform writeonly image2D u_value;
layout(rgba8, binding = 1) uniform writeonly image2D u_picture;
uniform ivec2 u_size;

const float kLeastSeen = 1e-4;  // opacity; of less, one minus the transmittance is too little of a float to divide by

float lightSeen(CloudRay cloud, Ray view) {
  if (tree.sunDir.w <= 0.0) return kDebugNone;
  float opacity = 1.0 - cloud.transmittance, light = cloud.sun, seen = opacity;
#if OPT_GROUND
  if (view.ground_m >= 0.0 && cloud.transmittance > 0.0) {
    light += cloud.transmittance * exp(-sunDepth(xyz(camera.position) + dvec3(view.dir) * double(view.ground_m), 0.0));
    seen = 1.0;
  }
#endif
  return seen > kLeastSeen ? light / seen : kDebugNone;
}

void main() {
  ivec2 pixel = tilePixel();
  if (any(greaterThanEqual(pixel, u_size))) return;
  vec2 ndc = vec2(2.0 * (float(pixel.x) + 0.5) / float(u_size.x) - 1.0, 1.0 - 2.0 * (float(pixel.y) + 0.5) / float(u_size.y));
  Ray view = cameraRay(camera, ndc);
  CloudPhases phases = cloudPhases(dot(view.dir, tree.sunDir.xyz));
  CloudRay cloud = marchClouds(xyz(camera.position), camera.position.w, camera.up.w, camera.forward.w, view.dir, view.ground_m, phases);
#if DEBUG_VIEW == WK_DEBUG_STEPS
  float value = cloud.cells > 0u ? float(cloud.samples) : kDebugNone;
#elif DEBUG_VIEW == WK_DEBUG_DETAIL
  float value = watched.most > 0.0 ? float(watched.level) : kDebugNone;
#elif DEBUG_VIEW == WK_DEBUG_OCCUPANCY
  float value = watched.way_m > 0.0 ? 1.0 - watched.empty_m / watched.way_m : kDebugNone;
#elif DEBUG_VIEW == WK_DEBUG_DENSITY
  float value = watched.greatest_per_m > 0.0 ? watched.greatest_per_m : kDebugNone;
#elif DEBUG_VIEW == WK_DEBUG_LIGHT
  float value = lightSeen(cloud, view);
#endif
  imageStore(u_value, pixel, vec4(value));
  imageStore(u_picture, pixel, vec4(isnan(value) ? kNanPaint : debugColour(uint(DEBUG_VIEW), value), 1.0));
}
