// Fills the view tables: one invocation per ray, slice after slice away from the camera.
#include "lib/air_view.glsl"
#include "welkin/shared/bindings.glsl.h"
layout(local_size_x = 8, local_size_y = 4) in;
layout(std140, binding = WK_AIR_PARAMS_BINDING) uniform AirUniforms { AirBlock u_air; };
layout(binding = WK_SKY_TRANSMITTANCE_UNIT) uniform sampler2D u_transmittance;
layout(binding = WK_SKY_VIEW_TRANSMITTANCE_UNIT) uniform sampler2D u_multiple;
layout(rgba16f, binding = 0) uniform writeonly image3D u_scatter;
layout(rgba16f, binding = 1) uniform writeonly image2D u_depth;

void store(uvec2 id, uint slice, AirViewSum sum, float scale) {
  vec3 light = sunIrradiance(u_air.params) * scale;
  imageStore(u_scatter, ivec3(id, slice), vec4(sum.smoothPart * light, 0.0));
  imageStore(u_scatter, ivec3(id, slice + kViewSlices), vec4(sum.peakPart * light, 0.0));
  if (id.y == 0u) imageStore(u_depth, ivec2(id.x, slice), vec4(sum.depth * scale, 0.0));
}

void main() {
  uvec2 id = gl_GlobalInvocationID.xy;
  bool ground = id.x < kViewGroundTexels;
  float u = ground ? float(id.x) / float(kViewGroundTexels - 1u) : float(id.x - kViewGroundTexels) / float(kViewSkyTexels - 1u);
  AirViewRay ray = airViewRay(u_air.view, viewCosine(u_air.view, u, ground), 2.0 * float(id.y) / float(kViewAzimuths - 1u) - 1.0);
  float h0 = u_air.view.anchorAltitude_m;
  float end = ground ? distanceToGround(u_air.params, h0, ray.mu) : distanceToTop(u_air.params, h0, ray.mu);
  float spacing = ground ? u_air.view.groundSlices : u_air.view.skySlices;
  float phases[AIR_LAYERS] = airPhases(u_air, ray.cosine);
  store(id, 0u, airViewStart(u_transmittance, u_multiple, u_air, ray, phases), kRateLength_m);
  AirViewSum sum = AirViewSum(vec3(0.0), vec3(0.0), vec3(0.0));
  float t = 0.0;
  for (uint slice = 1u; slice < kViewSlices; ++slice) {
    for (uint half_ = 1u; half_ <= 2u; ++half_) {
      float next = end * airSliceAt(spacing, (float(slice - 1u) + 0.5 * float(half_)) / float(kViewSlices - 1u));
      sum = airViewStep(u_transmittance, u_multiple, u_air, ray, phases, sum, t, next);
      t = next;
    }
    // A ray of no length (the rim of the shell) keeps the rate at its start.
    if (t > 0.0) store(id, slice, sum, kRateLength_m / t);
    else store(id, slice, airViewStart(u_transmittance, u_multiple, u_air, ray, phases), kRateLength_m);
  }
}
