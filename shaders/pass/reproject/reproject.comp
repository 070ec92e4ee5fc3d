// Fills the pixels that this frame's sixteenth does not march from the last frame's clouds, moved by their own distance and the camera's
// motion, and corrected by what the marched pixels around have changed. Pixels without valid history go to a list that is marched at once.
#include "lib/as_seen.glsl"
#include "lib/pixel_list.glsl"
#include "lib/reproject.glsl"
#include "welkin/shared/counters.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = WK_CAMERA_BINDING) uniform CameraUniforms { CameraBlock camera; };
layout(std430, binding = WK_COUNTERS_BINDING) buffer CounterBuffer { Counters counters; };
layout(binding = WK_CLOUD_CHANGE_UNIT) uniform sampler2D u_change;   // of the pixel of each 4 x 4 that was marched: new minus history
layout(rgba16f, binding = 0) uniform writeonly image2D u_light;
layout(rg32f, binding = 1) uniform writeonly image2D u_aux;
layout(r8ui, binding = 3) uniform writeonly uimage2D u_age;
layout(binding = WK_CLOUD_AGE_UNIT) uniform usampler2D u_oldAge;
uniform ivec2 u_size;
uniform ivec2 u_offset;
uniform bool u_refined;  // the tree changed since the last frame

const int kEdgeReach = 2;          // pixels
const float kResampleError = 0.03; // of 1: chosen for an error of 0.015 rms at 7 km a frame in orbit (docs/decisions/0004-reprojection.md)
const float kGreatChange = 0.06;   // of 1: a change over this is not smooth enough to be interpolated

// History is valid for as many frames as the camera takes to move by this share of the cloud's distance, and for one round of the 4 x 4.
// Where that is under kLeastAge it is not used at all: a pixel of history among new ones would show.
const float kParallax = 0.07;
const float kRound = 16.0;
const float kLeastAge = 3.0;

// How far interpolation may be off here: contrast of the four texels around, as it will be seen, times the distance from the nearest.
// A pixel is resampled up to 15 times until it is marched again, so little is much.
vec2 seenAt(ivec2 at) { return asSeen(texelFetch(u_oldLight, clamp(at, ivec2(0), u_size - 1), 0), 1.0); }
float resampleError(vec2 at) {
  ivec2 base = ivec2(floor(at - 0.5));
  vec2 a = seenAt(base), b = seenAt(base + ivec2(1, 0)), c = seenAt(base + ivec2(0, 1)), d = seenAt(base + ivec2(1, 1));
  vec2 contrast = max(max(a, b), max(c, d)) - min(min(a, b), min(c, d));
  vec2 f = fract(at - 0.5);
  vec2 off = min(f, 1.0 - f);
  return max(contrast.x, contrast.y) * max(off.x, off.y);
}

void fill(ivec2 pixel) {
  History h = findHistory(pixel, pixelDirection(camera, pixel, u_size), u_size);
  bool valid = h.valid;
  bool moving = !h.still || length(u_move) > 0.0;  // what is far away stays where it is, but something near may come before it
  if (valid && moving) {
    ivec2 centre = ivec2(h.at), last = u_size - 1;
    float a = texelFetch(u_oldAux, clamp(centre + ivec2(kEdgeReach, 0), ivec2(0), last), 0).x;
    float b = texelFetch(u_oldAux, clamp(centre - ivec2(kEdgeReach, 0), ivec2(0), last), 0).x;
    float c = texelFetch(u_oldAux, clamp(centre + ivec2(0, kEdgeReach), ivec2(0), last), 0).x;
    float d = texelFetch(u_oldAux, clamp(centre - ivec2(0, kEdgeReach), ivec2(0), last), 0).x;
    if (max(max(max(a, b), max(c, d)), h.found) > kEdge * min(min(min(a, b), min(c, d)), h.found)) valid = false;
    if (resampleError(h.at) > kResampleError) valid = false;
  }
  vec4 light = historyLight(h, pixel, u_size);
  if (moving || u_refined) {
    vec4 change = textureLod(u_change, (vec2(pixel - u_offset) * 0.25 + 0.5) / vec2(textureSize(u_change, 0)), 0.0);
    vec4 changed = vec4(max(light.rgb + change.rgb, vec3(0.0)), clamp(light.a + change.a, 0.0, 1.0));
    vec2 difference = abs(asSeen(changed, 1.0) - asSeen(light, 1.0));
    if (max(difference.x, difference.y) > kGreatChange) valid = false;
    light = changed;
  }
  uint age = texelFetch(u_oldAge, ivec2(h.at), 0).x + 1u;
  float most = min(kParallax * h.expected / max(length(u_move), 1e-3), kRound);
  if (float(age) > most || most < kLeastAge) valid = false;
  if (!valid) {
    listPixel(pixel);
    return;
  }
  imageStore(u_light, pixel, light);
  imageStore(u_age, pixel, uvec4(min(age, 255u)));
  imageStore(u_aux, pixel, h.still ? texelFetch(u_oldAux, pixel, 0)
                                   : vec4(h.distance, textureLod(u_oldAux, h.at / vec2(u_size), 0.0).y, 0.0, 0.0));
}

void main() {
  beginList();
  ivec2 pixel = ivec2(gl_WorkGroupID.xy) * 8 + listPlace();
  bool marched = all(equal(pixel & 3, u_offset));  // this frame
  if (all(lessThan(pixel, u_size)) && !marched) fill(pixel);
  uint listed = endList();
  if (gl_LocalInvocationIndex == 0u && listed > 0u) atomicAdd(counters.rejectedPixels, listed);
}
