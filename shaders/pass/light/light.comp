// One work group lights one brick: shadow rays from a 4^3 lattice through the tree to the top of the clouds, spread over the 8^3
// samples. A ray's level follows from position and distance alone, not from the brick it starts in, so neighbours agree on a face.
#include "lib/brick_image.glsl"
#include "lib/shadow.glsl"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(std430, binding = WK_BRICK_JOBS_BINDING) readonly buffer Jobs { GpuBrickJob jobs[]; };
uniform uint u_firstJob;

shared float s_depth[4][4][4];

void main() {
  GpuBrickJob job = jobs[u_firstJob + gl_WorkGroupID.x];
  uvec3 corner = uvec3(job.x, job.y, job.z);
  uvec3 l = gl_LocalInvocationID;
  double size_m = double(tree.stepLength_m) * double(levelSteps(job.level));
  dvec3 start = dvec3(corner) / tree.stepsPerMetre - tree.half_m + dvec3(l) * (size_m / 3.0LF);
  s_depth[l.z][l.y][l.x] = sunDepth(start);
  barrier();
  for (uint k = 0u; k < 8u; ++k) {
    uvec3 i = l * 2u + uvec3(k & 1u, (k >> 1u) & 1u, k >> 2u);
    vec3 at = vec3(i) * (3.0 / 7.0);
    uvec3 a = min(uvec3(at), uvec3(2u));
    vec3 f = at - vec3(a);
    vec4 x0 = vec4(s_depth[a.z][a.y][a.x], s_depth[a.z][a.y + 1u][a.x], s_depth[a.z + 1u][a.y][a.x], s_depth[a.z + 1u][a.y + 1u][a.x]);
    vec4 x1 = vec4(s_depth[a.z][a.y][a.x + 1u], s_depth[a.z][a.y + 1u][a.x + 1u], s_depth[a.z + 1u][a.y][a.x + 1u], s_depth[a.z + 1u][a.y + 1u][a.x + 1u]);
    vec4 x = mix(x0, x1, f.x);
    vec2 y = mix(x.xz, x.yw, f.y);
    float depth = mix(y.x, y.y, f.z);
    storeTexel(tree, job.brick, i, vec2(loadTexel(tree, job.brick, i).x, encodeDepth(depth)));
  }
}
