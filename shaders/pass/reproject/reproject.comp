// Fills the pixels that this frame's sixteenth does not march from the last frame's clouds, moved by their own distance and the camera's
// motion. Pixels without valid history go to a list that is marched at once.
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/camera.glsl.h"
#include "welkin/shared/counters.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = WK_CAMERA_BINDING) uniform CameraUniforms { CameraBlock camera; };
layout(std430, binding = WK_COUNTERS_BINDING) buffer CounterBuffer { Counters counters; };
layout(std430, binding = WK_PIXELS_BINDING) buffer PixelList { uint groups, one, one_, count, pixels[]; };
layout(binding = WK_CLOUD_LIGHT_UNIT) uniform sampler2D u_oldLight;
layout(binding = WK_CLOUD_AUX_UNIT) uniform sampler2D u_oldAux;
layout(rgba16f, binding = 0) uniform writeonly image2D u_light;
layout(rg32f, binding = 1) uniform writeonly image2D u_aux;
uniform ivec2 u_size;
uniform ivec2 u_offset;
uniform int u_phase;         // counts frames: the pixel of this rank in each 4 x 4 is marched
uniform vec3 u_move;         // camera now minus camera then, planet frame, m
uniform vec3 u_oldForward;   // the last frame's axes; right and up divided by the tangents of half the field of view
uniform vec3 u_oldRight;
uniform vec3 u_oldUp;

const float kSameTexel = 1e-3;     // a shift under this is below what 16-bit history resolves: copy, so that a still picture stays
const float kDistanceSlack = 0.2;  // history is of another surface if its distance is off by more than this share
const float kEdge = 1.3;           // neighbours whose distances differ by more than this factor are a silhouette: what it hides changes
const int kEdgeReach = 2;          // pixels
const float kResampleError = 0.03; // of 1: chosen for an error of 0.015 rms at 7 km a frame in orbit (docs/decisions/0004-reprojection.md)

vec3 rayDirection(ivec2 pixel) {
  vec2 ndc = vec2(2.0 * (float(pixel.x) + 0.5) / float(u_size.x) - 1.0, 1.0 - 2.0 * (float(pixel.y) + 0.5) / float(u_size.y));
  return normalize(vec3(xyz(camera.forward)) + vec3(xyz(camera.right)) * ndc.x + vec3(xyz(camera.up)) * ndc.y);
}

// Where a point, relative to the old camera, was in the old picture, in pixels.
vec3 oldPixel(vec3 v) {
  float z = dot(v, u_oldForward);
  vec2 ndc = vec2(dot(v, u_oldRight), dot(v, u_oldUp)) / z;
  return vec3((ndc.x + 1.0) * 0.5 * float(u_size.x), (1.0 - ndc.y) * 0.5 * float(u_size.y), z);
}

vec4 catmullRom(sampler2D tex, vec2 at) {
  vec2 base = floor(at - 0.5) + 0.5, f = at - base;
  vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w1 = 1.0 + f * f * (-2.5 + 1.5 * f), w2 = f * (0.5 + f * (2.0 - 1.5 * f)), w3 = f * f * (-0.5 + 0.5 * f);
  vec2 w12 = w1 + w2, size = vec2(u_size);
  vec2 t0 = (base - 1.0) / size, t3 = (base + 2.0) / size, t12 = (base + w2 / w12) / size;
  vec4 c = textureLod(tex, vec2(t12.x, t12.y), 0.0);
  vec4 sum = c * (w12.x * w12.y);
  sum += textureLod(tex, vec2(t12.x, t0.y), 0.0) * (w12.x * w0.y) + textureLod(tex, vec2(t12.x, t3.y), 0.0) * (w12.x * w3.y);
  sum += textureLod(tex, vec2(t0.x, t12.y), 0.0) * (w0.x * w12.y) + textureLod(tex, vec2(t3.x, t12.y), 0.0) * (w3.x * w12.y);
  float weight = w12.x * w12.y + w12.x * (w0.y + w3.y) + w12.y * (w0.x + w3.x);
  sum /= weight;
  return vec4(max(sum.rgb, vec3(0.0)), clamp(sum.a, 0.0, 1.0));
}

// Cloud that the camera is close to changes as it moves, however well it is moved along: nearer than this many frames' motion it is marched
// anew every frame, and nearer than that every fourth.
const float kAlways = 40.0;
const float kEveryFourth = 220.0;
// Which frame of 16 marches the pixel (x, y) of a 4 x 4: the inverse of kOrder in cloud_passes.cpp.
const int kRank[16] = int[16](0, 8, 2, 10, 12, 4, 14, 6, 3, 11, 1, 9, 15, 7, 13, 5);

// How far interpolation may be off here: contrast of the four texels around, as it will be seen, times the distance from the nearest.
// A pixel is resampled up to 15 times until it is marched again, so little is much.
vec2 seen(ivec2 at) {
  vec4 texel = texelFetch(u_oldLight, clamp(at, ivec2(0), u_size - 1), 0);
  float bright = 8.0 * texel.g;   // the exposure at 0 EV
  return vec2(bright / (1.0 + bright), texel.a * 0.5);
}
float resampleError(vec2 at) {
  ivec2 base = ivec2(floor(at - 0.5));
  vec2 a = seen(base), b = seen(base + ivec2(1, 0)), c = seen(base + ivec2(0, 1)), d = seen(base + ivec2(1, 1));
  vec2 contrast = max(max(a, b), max(c, d)) - min(min(a, b), min(c, d));
  vec2 f = fract(at - 0.5);
  vec2 off = min(f, 1.0 - f);
  return max(contrast.x, contrast.y) * max(off.x, off.y);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, u_size))) return;
  if (all(equal(pixel & 3, u_offset))) return;  // marched this frame
  vec3 dir = rayDirection(pixel);
  float distance = texelFetch(u_oldAux, pixel, 0).x;
  vec3 at = vec3(0.0);
  bool valid = true;
  float found = distance, expected = distance;
  for (int i = 0; i < 3 && valid; ++i) {
    vec3 v = dir * distance + u_move;
    at = oldPixel(v);
    valid = at.z > 0.0 && all(greaterThanEqual(at.xy, vec2(0.0))) && all(lessThan(at.xy, vec2(u_size)));
    if (!valid) break;
    found = texelFetch(u_oldAux, ivec2(at.xy), 0).x;
    expected = length(v);
    if (i < 2) {
      float ratio = found / max(expected, 1e-3);
      valid = max(ratio, 1.0 / ratio) < kEdge;  // not another surface that happens to agree with itself
      distance *= ratio;
    }
  }
  vec2 shift = abs(at.xy - (vec2(pixel) + 0.5));
  if (valid && max(shift.x, shift.y) >= kSameTexel) {
    valid = abs(found - expected) <= kDistanceSlack * expected;
    ivec2 centre = ivec2(at.xy), last = u_size - 1;
    float a = texelFetch(u_oldAux, clamp(centre + ivec2(kEdgeReach, 0), ivec2(0), last), 0).x;
    float b = texelFetch(u_oldAux, clamp(centre - ivec2(kEdgeReach, 0), ivec2(0), last), 0).x;
    float c = texelFetch(u_oldAux, clamp(centre + ivec2(0, kEdgeReach), ivec2(0), last), 0).x;
    float d = texelFetch(u_oldAux, clamp(centre - ivec2(0, kEdgeReach), ivec2(0), last), 0).x;
    if (max(max(a, b), max(c, d)) > kEdge * min(min(a, b), min(c, d))) valid = false;
    if (resampleError(at.xy) > kResampleError) valid = false;
  }
  float frames = expected / max(length(u_move), 1e-3);
  int rank = kRank[(pixel.x & 3) + 4 * (pixel.y & 3)];
  if (frames < kAlways || (frames < kEveryFourth && ((rank ^ u_phase) & 3) == 0)) valid = false;
  if (!valid) {
    uint slot = atomicAdd(count, 1u);
    pixels[slot] = uint(pixel.x) | (uint(pixel.y) << 16u);
    if ((slot & 63u) == 0u) atomicAdd(groups, 1u);
    atomicAdd(counters.rejectedPixels, 1u);
    return;
  }
  if (max(shift.x, shift.y) < kSameTexel) {
    imageStore(u_light, pixel, texelFetch(u_oldLight, pixel, 0));
    imageStore(u_aux, pixel, texelFetch(u_oldAux, pixel, 0));
    return;
  }
  imageStore(u_light, pixel, catmullRom(u_oldLight, at.xy));
  imageStore(u_aux, pixel, vec4(distance, textureLod(u_oldAux, at.xy / vec2(u_size), 0.0).y, 0.0, 0.0));
}
