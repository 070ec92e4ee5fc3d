#pragma once
// The camera as shaders see it (std430/std140, doubles first), and rays. A ray's geometry against the spheres is computed once in
// fp64 and handed on as floats anchored where the ray enters the shell (DESIGN, Precision).
#include "welkin/shared/prelude.glsl.h"
#ifdef __cplusplus
namespace welkin::shared { using glm::dvec3; struct alignas(32) dvec4 { double x, y, z, w; }; inline dvec3 xyz(dvec4 v) { return {v.x, v.y, v.z}; } }
#define WK_D(x) (x)
#else
dvec3 xyz(dvec4 v) { return v.xyz; }
#define WK_D(x) double(x)
#endif
WK_BEGIN

struct CameraBlock {
  dvec4 position;   // planet frame, m; w: altitude above the ground, m (from doubles, not from |position| in the shader)
  dvec4 forward;    // unit; w: planet radius, m
  dvec4 right;      // unit times tan of half the horizontal field of view; w: altitude of the shell's top (air, or cloud if no air), m
  dvec4 up;         // unit times tan of half the vertical field of view; w: distance from the centre, m
};

struct Ray {
  vec3 dir;          // planet frame, unit
  float ground_m;    // distance from the camera to the ground, or -1 if the ray does not meet it in front of the camera
  float anchor_m;    // distance from the camera to the anchor: the entry into the shell, 0 inside it, -1 if the ray misses it
  float altitude_m;  // of the anchor
  float mu;          // cosine of the ray's zenith angle at the anchor
  float exit_m;      // distance from the camera to the exit from the shell (behind the ground too, if it hits)
};

// Near and far distance to the sphere of `radius` around the centre from a point at distance r, altitude dh = r - radius given
// exactly, along a ray with b = r mu and sine s of the zenith angle; no cancellation: roots from c = dh (r + radius).
// near > far: no hit. Inside: near is 0.
struct Interval { float near; float far; };
WK_FN Interval sphereInterval(double b, double c) {
  double disc = b * b - c;
  if (disc < WK_D(0.0) || (c > WK_D(0.0) && b >= WK_D(0.0))) return WK_NEW(Interval, F(1.0), F(0.0));
  double root = sqrt(disc);
  if (c > WK_D(0.0)) return WK_NEW(Interval, float(c / (root - b)), float(root - b));
  return WK_NEW(Interval, F(0.0), float(b < WK_D(0.0) ? root - b : -c / (b + root)));
}

// The ray through the point `ndc` (-1..1, +y up) of the picture.
WK_FN Ray cameraRay(CameraBlock camera, vec2 ndc) {
  dvec3 d = xyz(camera.forward) + xyz(camera.right) * double(ndc.x) + xyz(camera.up) * double(ndc.y);
  d = d / sqrt(dot(d, d));
  double r = camera.up.w, h = camera.position.w, radius = camera.forward.w, top = camera.right.w;
  double b = dot(xyz(camera.position), d);
  Ray ray;
  ray.dir = vec3(float(d.x), float(d.y), float(d.z));
  Interval ground = sphereInterval(b, h * (r + radius));
  ray.ground_m = ground.near <= ground.far ? ground.near : F(-1.0);
  double dh = h - top;
  Interval shell = sphereInterval(b, dh * (r + radius + top));
  if (dh <= WK_D(0.0)) {
    ray.anchor_m = F(0.0);
    ray.altitude_m = float(h);
    ray.mu = float(b / r);
    ray.exit_m = shell.far;
  } else if (shell.near <= shell.far) {
    ray.anchor_m = shell.near;
    ray.altitude_m = float(top);
    // b at the entry is -root exactly
    ray.mu = float(-sqrt(max(b * b - dh * (r + radius + top), WK_D(0.0))) / (radius + top));
    ray.exit_m = shell.far;
  } else {
    ray.anchor_m = F(-1.0);
    ray.altitude_m = F(0.0);
    ray.mu = F(0.0);
    ray.exit_m = F(-1.0);
  }
  return ray;
}

// Altitude at distance t from the anchor (altitude h0, zenith cosine mu): h = (h0 (2R + h0) + t (2 r0 mu + t)) / (r(t) + R).
WK_FN float altitudeAlong(float h0, float mu, float t, float radius) {
  float r0 = radius + h0;
  float num = h0 * (F(2.0) * radius + h0) + t * (F(2.0) * r0 * mu + t);
  float r = sqrt(max(radius * radius + num, F(0.0)));
  return num / (r + radius);
}

WK_END
