// Test: airAlong for a list of picture points and distances.
#include "lib/air.glsl"
#include "welkin/shared/bindings.glsl.h"
layout(local_size_x = 64) in;
layout(std140, binding = WK_CAMERA_BINDING) uniform CameraUniforms { CameraBlock camera; };
layout(std140, binding = WK_AIR_PARAMS_BINDING) uniform AirUniforms { AirBlock u_air; };
layout(binding = WK_SKY_VIEW_SCATTER_UNIT) uniform sampler3D u_viewScatter;
layout(binding = WK_SKY_VIEW_TRANSMITTANCE_UNIT) uniform sampler2D u_viewDepth;
layout(std430, binding = 0) readonly buffer Rays { vec4 rays[]; };  // ndc, distance
layout(std430, binding = 1) buffer Answers { vec4 answers[]; };     // in-scatter, transmittance

void main() {
  uint i = gl_GlobalInvocationID.x;
  Ray ray = cameraRay(camera, rays[i].xy);
  AirView v = airAlong(u_viewScatter, u_viewDepth, u_air.params, u_air.view, ray, rays[i].z);
  answers[2u * i] = vec4(v.inscatter, 0.0);
  answers[2u * i + 1u] = vec4(v.transmittance, 0.0);
}
