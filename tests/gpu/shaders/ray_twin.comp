// Test: rays of a camera.
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/camera.glsl.h"
layout(local_size_x = 64) in;
layout(std140, binding = WK_CAMERA_BINDING) uniform CameraUniforms { CameraBlock camera; };
layout(std430, binding = 0) readonly buffer Inputs { vec2 points[]; };
layout(std430, binding = 1) writeonly buffer Answers { float answers[]; };

void main() {
  uint row = gl_GlobalInvocationID.x, o = 8u * row;
  Ray ray = cameraRay(camera, points[row]);
  float t = max(ray.exit_m - ray.anchor_m, 0.0) * 0.37;
  float floats[8] = float[8](ray.dir.x, ray.dir.y, ray.dir.z, ray.ground_m, ray.anchor_m, ray.mu, ray.exit_m,
    altitudeAlong(ray.altitude_m, ray.mu, t, float(camera.forward.w)));
  for (uint i = 0u; i < 8u; ++i) answers[o + i] = floats[i];
}
