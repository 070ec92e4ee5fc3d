// Where a pixel's cloud was in the last frame's picture, and what that picture holds there.
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/camera.glsl.h"

layout(binding = WK_CLOUD_LIGHT_UNIT) uniform sampler2D u_oldLight;
layout(binding = WK_CLOUD_AUX_UNIT) uniform sampler2D u_oldAux;
uniform vec3 u_move;         // camera now minus camera then, planet frame, m
uniform vec3 u_oldForward;   // the last frame's axes; right and up divided by the tangents of half the field of view
uniform vec3 u_oldRight;
uniform vec3 u_oldUp;

const float kSameTexel = 1e-3;     // a shift under this is below what 16-bit history resolves: copy, so that a still picture stays
const float kDistanceSlack = 0.2;  // history is of another surface if its distance is off by more than this share
const float kEdge = 1.3;           // neighbours whose distances differ by more than this factor are a silhouette: what it hides changes

vec3 pixelDirection(CameraBlock camera, ivec2 pixel, ivec2 size) {
  vec2 ndc = vec2(2.0 * (float(pixel.x) + 0.5) / float(size.x) - 1.0, 1.0 - 2.0 * (float(pixel.y) + 0.5) / float(size.y));
  return normalize(vec3(xyz(camera.forward)) + vec3(xyz(camera.right)) * ndc.x + vec3(xyz(camera.up)) * ndc.y);
}

// Where a point, relative to the old camera, was in the old picture, in pixels.
vec3 oldPixel(vec3 v, ivec2 size) {
  float z = dot(v, u_oldForward);
  vec2 ndc = vec2(dot(v, u_oldRight), dot(v, u_oldUp)) / z;
  return vec3((ndc.x + 1.0) * 0.5 * float(size.x), (1.0 - ndc.y) * 0.5 * float(size.y), z);
}

vec4 catmullRom(sampler2D tex, vec2 at, ivec2 texels) {
  vec2 base = floor(at - 0.5) + 0.5, f = at - base;
  vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w1 = 1.0 + f * f * (-2.5 + 1.5 * f), w2 = f * (0.5 + f * (2.0 - 1.5 * f)), w3 = f * f * (-0.5 + 0.5 * f);
  vec2 w12 = w1 + w2, size = vec2(texels);
  vec2 t0 = (base - 1.0) / size, t3 = (base + 2.0) / size, t12 = (base + w2 / w12) / size;
  vec4 c = textureLod(tex, vec2(t12.x, t12.y), 0.0);
  vec4 sum = c * (w12.x * w12.y);
  sum += textureLod(tex, vec2(t12.x, t0.y), 0.0) * (w12.x * w0.y) + textureLod(tex, vec2(t12.x, t3.y), 0.0) * (w12.x * w3.y);
  sum += textureLod(tex, vec2(t0.x, t12.y), 0.0) * (w0.x * w12.y) + textureLod(tex, vec2(t3.x, t12.y), 0.0) * (w3.x * w12.y);
  float weight = w12.x * w12.y + w12.x * (w0.y + w3.y) + w12.y * (w0.x + w3.x);
  sum /= weight;
  return vec4(max(sum.rgb, vec3(0.0)), clamp(sum.a, 0.0, 1.0));
}

struct History {
  bool valid;
  bool still;      // the same texel: copy it
  vec2 at;         // in the old picture, pixels
  float distance;  // of this pixel's cloud from the camera now
  float found, expected;  // from the camera then: what the old picture holds there, and what it should
};

// Three turns: from the distance that this pixel had, to that of the cloud which is here now.
History findHistory(ivec2 pixel, vec3 dir, ivec2 size) {
  float distance = texelFetch(u_oldAux, pixel, 0).x;
  History h = History(true, false, vec2(0.0), distance, distance, distance);
  for (int i = 0; i < 3 && h.valid; ++i) {
    vec3 v = dir * h.distance + u_move;
    vec3 at = oldPixel(v, size);
    h.at = at.xy;
    h.valid = at.z > 0.0 && all(greaterThanEqual(at.xy, vec2(0.0))) && all(lessThan(at.xy, vec2(size)));
    if (!h.valid) break;
    h.found = texelFetch(u_oldAux, ivec2(at.xy), 0).x;
    h.expected = length(v);
    if (i < 2) {
      float ratio = h.found / max(h.expected, 1e-3);
      h.valid = max(ratio, 1.0 / ratio) < kEdge;  // not another surface that happens to agree with itself
      h.distance *= ratio;
    }
  }
  vec2 shift = abs(h.at - (vec2(pixel) + 0.5));
  h.still = max(shift.x, shift.y) < kSameTexel;
  if (h.valid && !h.still) h.valid = abs(h.found - h.expected) <= kDistanceSlack * h.expected;
  return h;
}

vec4 historyLight(History h, ivec2 pixel, ivec2 size) {
  return h.still ? texelFetch(u_oldLight, pixel, 0) : catmullRom(u_oldLight, h.at, size);
}
