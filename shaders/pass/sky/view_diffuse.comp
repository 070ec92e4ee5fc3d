// What diffuse light adds from the camera along every ray, on few rays and slices: it varies slowly in angle. view.comp adds it.
#include "lib/air_view.glsl"
#include "welkin/shared/bindings.glsl.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = WK_AIR_PARAMS_BINDING) uniform AirUniforms { AirBlock u_air; };
layout(binding = WK_SKY_TRANSMITTANCE_UNIT) uniform sampler2D u_sunDepth;
layout(binding = WK_SKY_FIELD_UNIT) uniform sampler2DArray u_field;
layout(rgba32f, binding = 0) uniform writeonly image3D u_out;

void main() {
  uvec2 id = gl_GlobalInvocationID.xy;
  bool ground = id.x < kDiffuseGroundTexels;
  float u = ground ? float(id.x) / float(kDiffuseGroundTexels - 1u) : float(id.x - kDiffuseGroundTexels) / float(kDiffuseSkyTexels - 1u);
  AirPath path = airViewPath(u_air.view, viewCosine(u_air.view, u, ground), 2.0 * float(id.y) / float(kDiffuseAzimuths - 1u) - 1.0);
  float end = ground ? distanceToGround(u_air.params, path.altitude_m, path.mu) : distanceToTop(u_air.params, path.altitude_m, path.mu);
  float spacing = ground ? u_air.view.groundSlices : u_air.view.skySlices;
  AirTerms terms = airTerms(path, airPhases(u_air, path.cosine, false));
  AirNode here = airNode(u_sunDepth, u_field, u_air, path, terms, 0.0);
  vec3 source = kSourceScale * here.light / max(here.extinction, vec3(1e-30));
  imageStore(u_out, ivec3(id, 0), vec4(source, 0.0));
  AirSum sum = airNothing();
  float t = 0.0;
  for (uint slice = 1u; slice < kDiffuseSlices; ++slice) {
    for (int piece = 1; piece <= VIEW_PIECES; ++piece) {
      float next = end * airSliceAt(spacing, (float(slice - 1u) + float(piece) / float(VIEW_PIECES)) / float(kDiffuseSlices - 1u));
      sum = airStretch(u_sunDepth, u_field, u_air, path, terms, sum, t, next);
      t = next;
    }
    if (t > 0.0) source = airMeanSource(sum.light, sum.depth);
    imageStore(u_out, ivec3(id, slice), vec4(source, 0.0));
  }
}
