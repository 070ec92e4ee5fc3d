// One work group lights one brick. The sun's depth of a sample is a near part, integrated sample by sample through one lattice spacing of
// the brick's own level, and a far part from there to the top of the clouds, which is smooth: 4^3 shadow rays through the tree,
// interpolated as they are stored: a tenth of the way from a depth of 0 to 200 is 0.5 then, not 20 (docs/decisions/0018). A far ray's level
// follows from position and distance alone, so neighbours agree on a face.
// At the brick's eight corners the cloud's chords are kept (shared/cloud_light.glsl.h): along a chord its depth stays the same, so they are smooth
// in a deck thinner than a voxel too. Three half chords a corner, the fourth being the way to the sun: 24 rays.
#include "lib/brick_image.glsl"
#include "lib/shadow.glsl"
#ifndef LIGHT_NEAR_SAMPLES
#define LIGHT_NEAR_SAMPLES 3
#endif

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(std430, binding = WK_BRICK_JOBS_BINDING) readonly buffer Jobs { GpuBrickJob jobs[]; };
layout(std430, binding = WK_CHORDS_BINDING) writeonly buffer ChordsOut { uint chordsOut[]; };  // 8 a brick, x fastest
uniform uint u_firstJob;

const float kNearCells = 7.0 / 3.0;  // one spacing of the lattice
const int kNearSamples = LIGHT_NEAR_SAMPLES;
const uint kChordCoarser = 1u;       // levels above the brick's own: voxels that filter what lies between corners

shared float s_far[4][4][4];
shared float s_cornerSun[8];    // optical depth towards the sun at corners
shared float s_halfChord[3][8];  // away from the sun, up, down

// Encoded.
float farDepth(uvec3 i) {
  vec3 at = vec3(i) * (3.0 / 7.0);
  uvec3 a = min(uvec3(at), uvec3(2u));
  vec3 f = at - vec3(a);
  vec4 x0 = vec4(s_far[a.z][a.y][a.x], s_far[a.z][a.y + 1u][a.x], s_far[a.z + 1u][a.y][a.x], s_far[a.z + 1u][a.y + 1u][a.x]);
  vec4 x1 = vec4(s_far[a.z][a.y][a.x + 1u], s_far[a.z][a.y + 1u][a.x + 1u], s_far[a.z + 1u][a.y][a.x + 1u], s_far[a.z + 1u][a.y + 1u][a.x + 1u]);
  vec4 x = mix(x0, x1, f.x);
  vec2 y = mix(x.xz, x.yw, f.y);
  return mix(y.x, y.y, f.z);
}

// Sum of densities at midpoints along the near part, from the tree at the brick's own level: on a face both neighbours see the same.
float nearSum(Walk walk, uint level, float cell_m, uint mapLevel) {
  float sum = 0.0;
  for (int n = 0; n < kNearSamples; ++n) {
    uvec3 p = walkTo(walk, cell_m * (kNearCells * (float(n) + 0.5) / float(kNearSamples)));
    uint word = lookUp(p, level, mapLevel);
    sum += sampleBrick(wordBrick(word), nodeLocal(p, wordLevel(word)) * 7.0).r;   // an empty node has the zero brick
  }
  return sum;
}

void main() {
  GpuBrickJob job = jobs[u_firstJob + gl_WorkGroupID.x];
  uvec3 l = gl_LocalInvocationID;
  double size_m = double(tree.stepLength_m) * double(levelSteps(job.level));
  float cell_m = float(size_m) / 7.0;
  dvec3 start = dvec3(job.x, job.y, job.z) / tree.stepsPerMetre - tree.half_m + dvec3(l) * (size_m / double(3.0));
  s_far[l.z][l.y][l.x] = encodeDepth(sunDepth(start, kNearCells * cell_m));
  barrier();
  float perSample = tree.maxExtinction_per_m * cell_m * kNearCells / float(kNearSamples);
  float reach_m = length(vec3(start) - tree.mapCentre.xyz) + 2.0 * float(size_m);  // every sample is nearer than this
  uint mapLevel = mapLevelAt(tree.rootSize_m / reach_m, tree.mapBase, tree.depth);
  Walk walk;
  walk.dirSteps = tree.sunDir.xyz * float(tree.stepsPerMetre);
  for (uint k = 0u; k < 8u; ++k) {
    uvec3 i = l * 2u + uvec3(k & 1u, (k >> 1u) & 1u, k >> 2u);
    walk.origin = brickSample(uvec3(job.x, job.y, job.z), job.level, i);
    float depth = decodeDepth(farDepth(i)) + perSample * nearSum(walk, job.level, cell_m, mapLevel);
    storeTexel(tree, job.brick, i, vec2(loadTexel(tree, job.brick, i).x, encodeDepth(depth)));
    uvec3 corner = i / 7u;
    if (corner * 7u == i) s_cornerSun[corner.x | (corner.y << 1u) | (corner.z << 2u)] = depth;
  }
  uint ray = gl_LocalInvocationIndex, corner = ray & 7u, kind = ray >> 3u;
  if (kind < 3u) {
    dvec3 at = start - dvec3(l) * (size_m / double(3.0)) + dvec3(corner & 1u, (corner >> 1u) & 1u, corner >> 2u) * size_m;
    vec3 up = vec3(at / length(at));
    vec3 dir = kind == 0u ? -tree.sunDir.xyz : kind == 1u ? up : -up;
    s_halfChord[kind][corner] = chordDepth(at, dir, max(job.level, kChordCoarser) - kChordCoarser, float(size_m));
  }
  barrier();
  float sunChord = s_cornerSun[corner] + s_halfChord[0][corner], upChord = s_halfChord[1][corner] + s_halfChord[2][corner];
  if (ray < 8u) chordsOut[8u * job.brick + ray] = packUnorm2x16(vec2(encodeDepth(sunChord), encodeDepth(upChord)));
}
