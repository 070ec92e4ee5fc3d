// Fills the view tables: one invocation per ray, slice after slice away from the camera.
#include "lib/air_view.glsl"
#include "welkin/shared/bindings.glsl.h"
layout(local_size_x = 8, local_size_y = 4) in;
layout(std140, binding = WK_AIR_PARAMS_BINDING) uniform AirUniforms { AirBlock u_air; };
layout(binding = WK_SKY_TRANSMITTANCE_UNIT) uniform sampler2D u_sunDepth;
layout(binding = WK_SKY_FIELD_UNIT) uniform sampler2DArray u_field;
layout(binding = WK_SKY_VIEW_SCATTER_UNIT) uniform sampler3D u_diffuse;
layout(rgba16f, binding = 0) uniform writeonly image3D u_scatter;
layout(rgba16f, binding = 1) uniform writeonly image2D u_depth;

void store(uvec2 id, uint slice, vec3 light, vec3 peak, vec3 depthRate) {
  vec3 diffuse = vec3(0.0);
#if VIEW_DIFFUSE
  bool ground = id.x < kViewGroundTexels;
  float u = ground ? float(id.x) / float(kViewGroundTexels - 1u) : float(id.x - kViewGroundTexels) / float(kViewSkyTexels - 1u);
  float count = float(ground ? kDiffuseGroundTexels : kDiffuseSkyTexels);
  vec3 at = vec3(((ground ? 0.0 : float(kDiffuseGroundTexels)) + texelCoord(u, count) * count) / float(kDiffuseGroundTexels + kDiffuseSkyTexels),
                 texelCoord(float(id.y) / float(kViewAzimuths - 1u), float(kDiffuseAzimuths)),
                 texelCoord(float(slice) / float(kViewSlices - 1u), float(kDiffuseSlices)));
  diffuse = textureLod(u_diffuse, at, 0.0).rgb;
#endif
  imageStore(u_scatter, ivec3(id, slice), vec4(light + diffuse, 0.0));
  imageStore(u_scatter, ivec3(id, slice + kViewSlices), vec4(peak, 0.0));
  if (id.y == 0u) imageStore(u_depth, ivec2(id.x, slice), vec4(depthRate * kRateLength_m, 0.0));
}

void main() {
  uvec2 id = gl_GlobalInvocationID.xy;
  bool ground = id.x < kViewGroundTexels;
  float u = ground ? float(id.x) / float(kViewGroundTexels - 1u) : float(id.x - kViewGroundTexels) / float(kViewSkyTexels - 1u);
  AirPath path = airViewPath(u_air.view, viewCosine(u_air.view, u, ground), 2.0 * float(id.y) / float(kViewAzimuths - 1u) - 1.0);
  float end = ground ? distanceToGround(u_air.params, path.altitude_m, path.mu) : distanceToTop(u_air.params, path.altitude_m, path.mu);
  float spacing = ground ? u_air.view.groundSlices : u_air.view.skySlices;
  AirTerms terms = airTerms(path, airPhases(u_air, path.cosine, false));
  // In the limit of no length: what is at the camera.
  AirNode here = airNode(u_sunDepth, u_field, u_air, path, terms, 0.0);
  vec3 scale = kSourceScale / max(here.extinction, vec3(1e-30));
  store(id, 0u, here.light * scale, here.peak * scale, here.extinction);
  AirSum sum = airNothing();
  float t = 0.0;
  for (uint slice = 1u; slice < kViewSlices; ++slice) {
    for (int piece = 1; piece <= VIEW_PIECES; ++piece) {
      float next = end * airSliceAt(spacing, (float(slice - 1u) + float(piece) / float(VIEW_PIECES)) / float(kViewSlices - 1u));
      sum = airStretch(u_sunDepth, u_field, u_air, path, terms, sum, t, next);
      t = next;
    }
    // A ray of no length (the rim of the shell) keeps what is at its start.
    if (t > 0.0) store(id, slice, airMeanSource(sum.light, sum.depth), airMeanSource(sum.peak, sum.depth), sum.depth / t);
    else store(id, slice, here.light * scale, here.peak * scale, here.extinction);
  }
}
