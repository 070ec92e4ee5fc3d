// The shared walk, with the scene's constants filled in.
#include "lib/tree.glsl"
#include "welkin/shared/walk.glsl.h"

Walk startWalk(dvec3 start_planet, vec3 dir) {
  return startWalk((start_planet + tree.half_m) * tree.stepsPerMetre, dir, float(tree.stepsPerMetre));
}
float leaveNode(Walk walk, vec3 steps, float size, float t) { return leaveNode(walk, steps, size, t, tree.stepLength_m); }

// Which half of its parent the node of `level` at distance t lies in, an axis: 0 or 1.
uvec3 walkOctant(Walk walk, float t, uint level) { return (walkTo(walk, t) >> min(32u - level, 31u)) & 1u; }
