// The shared walk, with the scene's constants filled in.
#include "lib/tree.glsl"
#include "welkin/shared/walk.glsl.h"

Walk startWalk(dvec3 start_planet, vec3 dir) {
  return startWalk((start_planet + tree.half_m) * tree.stepsPerMetre, dir, float(tree.stepsPerMetre));
}
float pastExit(float t) { return pastExit(t, tree.stepLength_m); }
