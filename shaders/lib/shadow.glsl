// Optical depth towards the sun, through the resident octree.
#include "welkin/shared/camera.glsl.h"
#include "lib/walk.glsl"

#ifndef LIGHT_REACH  // others for comparisons (RenderSettings::light)
#define LIGHT_REACH 1.5
#define LIGHT_NODE_SAMPLES 2
#endif
const float kShadowReach = LIGHT_REACH;     // a node is sampled up to this many times its size from the start of the ray: voxels of 1/10 distance
const float kOpaque = 200.0;        // optical depth past which no light is left: exp(-200 / 4) in the widest octave
const int kMaxVisits = 256;         // well over the worst case of 30 levels of 6 cells

// From `skip_m` along the ray onwards to the top of the clouds.
float sunDepth(dvec3 start_planet, float skip_m) {
  vec3 dir = tree.sunDir.xyz;
  double r = length(start_planet);
  double radius = double(tree.planetRadius_m);
  double b = dot(start_planet, dvec3(dir));
  double top = radius + double(tree.shadowTop_m);
  Interval shell = sphereInterval(b, (r - top) * (r + top));
  Interval ground = sphereInterval(b, (r - radius) * (r + radius));
  if (shell.near > shell.far) return 0.0;
  if (ground.near <= ground.far && r > radius) return kOpaque;  // behind the planet
  Walk walk = startWalk(start_planet, dir);
  // how far the start is from where the maps are centred; along the ray that grows by at most t
  float fromCentre = length(vec3(start_planet) - tree.mapCentre.xyz);
  float t = max(shell.near, skip_m), end = shell.far, depth = 0.0;
  if (t >= end) return 0.0;
  int visit = 0;
  do {
    vec3 steps;
    uint word, at;
    float next;
    bool empty;
    do {  // on to the next brick that is not empty
      uvec3 p = walkTo(walk, t);
      float reach = min(kShadowReach / max(t, 1.0), tree.detail / max(fromCentre - t, tree.sampleNear_m));  // not finer than the view sees
      uint level = detailAt(reach * tree.rootSize_m, tree.depth).level;
      word = lookUp(p, level, mapLevelAt(tree.rootSize_m / (fromCentre + t), tree.mapBase, tree.depth));
      at = wordLevel(word);
      steps = nodeSteps(p, at);
      next = min(t + leaveNode(walk, steps, levelSteps(at), t), end);
      empty = wordEmpty(word);
      t = empty ? next : t;
      visit++;
    } while (empty && t < end && visit < kMaxVisits);
    // two midpoint samples resolve a node of seven cells well enough for a far depth, which is stored on a 4^3 lattice
    float cellsPerStep = 7.0 * levelStepsInverse(at);
    vec3 local = steps * cellsPerStep;
    vec3 slope = walk.dirSteps * cellsPerStep;
    float part_m = (next - t) / float(LIGHT_NODE_SAMPLES);
    float sum = 0.0;
    for (int n = 0; n < LIGHT_NODE_SAMPLES; ++n) sum += sampleBrick(wordBrick(word), local + slope * ((float(n) + 0.5) * part_m)).r;
    depth += sum * part_m * tree.maxExtinction_per_m;
    t = next;
  } while (t < end && depth < kOpaque && visit < kMaxVisits);
  return min(depth, kOpaque);
}
