// Optical depth towards the sun and along a cloud's chords, through the resident octree.
#include "welkin/shared/camera.glsl.h"
#include "lib/walk.glsl"

#ifndef LIGHT_REACH  // others for comparisons (RenderSettings::light)
#define LIGHT_REACH 1.5
#define LIGHT_NODE_SAMPLES 2
#endif
const float kShadowReach = LIGHT_REACH;     // a node is sampled up to this many times its size from the start of the ray: voxels of 1/10 distance
const float kOpaque = 200.0;        // optical depth past which no beam is left (exp(-0.3 * 200)), and of diffuse light a fiftieth
const int kMaxVisits = 256;         // well over the worst case of 30 levels of 6 cells
const int kChordSamples = 7;        // of a node: one a voxel
const float kChordReach_m = 32e3;   // of a chord, besides its brick: farther cloud is no neighbour

// Between two distances along a ray, from levels down to `finest` with so many midpoint samples in each node.
float depthBetween(dvec3 start_planet, vec3 dir, float t, float end, uint finest, int samples) {
  if (t >= end) return 0.0;
  Walk walk = startWalk(start_planet, dir);
  // how far the start is from where the maps are centred; along the ray that grows by at most t
  float fromCentre = length(vec3(start_planet) - tree.mapCentre.xyz);
  float depth = 0.0;
  int visit = 0;
  do {
    vec3 steps;
    uint word, at;
    float next;
    bool empty;
    do {  // on to the next brick that is not empty
      uvec3 p = walkTo(walk, t);
      float reach = min(kShadowReach / max(t, 1.0), tree.detail / max(fromCentre - t, tree.sampleNear_m));  // not finer than the view sees
      uint level = min(detailAt(reach * tree.rootSize_m, tree.depth).level, finest);
      word = lookUp(p, level, mapLevelAt(tree.rootSize_m / (fromCentre + t), tree.mapBase, tree.depth));
      at = wordLevel(word);
      steps = nodeSteps(p, at);
      next = min(t + leaveNode(walk, steps, levelSteps(at), t), end);
      empty = wordEmpty(word);
      t = empty ? next : t;
      visit++;
    } while (empty && t < end && visit < kMaxVisits);
    float cellsPerStep = 7.0 * levelStepsInverse(at);
    vec3 local = steps * cellsPerStep;
    vec3 slope = walk.dirSteps * cellsPerStep;
    float part_m = (next - t) / float(samples);
    float sum = 0.0;
    for (int n = 0; n < samples; ++n) sum += sampleBrick(wordBrick(word), local + slope * ((float(n) + 0.5) * part_m)).r;
    depth += sum * part_m * tree.maxExtinction_per_m;
    t = next;
  } while (t < end && depth < kOpaque && visit < kMaxVisits);
  return min(depth, kOpaque);
}

// Where a ray is below the top of the clouds, and not behind the ground; near > far: nowhere.
Interval cloudyPart(dvec3 start_planet, vec3 dir, out bool ends) {
  double r = length(start_planet), radius = double(tree.planetRadius_m), top = radius + double(tree.shadowTop_m);
  double b = dot(start_planet, dvec3(dir));
  Interval shell = sphereInterval(b, (r - top) * (r + top)), ground = sphereInterval(b, (r - radius) * (r + radius));
  ends = ground.near <= ground.far && r > radius;
  if (ends) shell.far = min(shell.far, ground.near);
  return shell;
}

// From `skip_m` along the ray onwards to the top of the clouds. Two samples resolve a node of seven cells well enough for a far depth, which is
// kept on a 4^3 lattice.
float sunDepth(dvec3 start_planet, float skip_m) {
  bool behindPlanet;
  Interval part = cloudyPart(start_planet, tree.sunDir.xyz, behindPlanet);
  if (part.near > part.far) return 0.0;
  if (behindPlanet) return kOpaque;
  return depthBetween(start_planet, tree.sunDir.xyz, max(part.near, skip_m), part.far, tree.depth, LIGHT_NODE_SAMPLES);
}

// Of half a chord: from a point on in one direction.
float chordDepth(dvec3 start_planet, vec3 dir, uint finest, float brick_m) {
  bool ends;
  Interval part = cloudyPart(start_planet, dir, ends);
  return depthBetween(start_planet, dir, part.near, min(part.far, kChordReach_m + brick_m), finest, kChordSamples);
}
