// Walking a ray through the resident octree. Positions: fixed point at the start of the ray plus a float distance.
#include "lib/tree.glsl"

struct Walk {
  uvec3 origin;      // fixed point
  vec3 dirSteps;     // steps a metre
  vec3 metrePerStep; // reciprocal, huge where a component is 0
};

Walk startWalk(dvec3 start_planet, vec3 dir) {
  Walk walk;
  dvec3 s = clamp((start_planet + tree.half_m) * tree.stepsPerMetre, 0.0LF, 4294967295.0LF);
  walk.origin = uvec3(s);
  walk.dirSteps = dir * float(tree.stepsPerMetre);
  walk.metrePerStep = vec3(dir.x == 0.0 ? 1e30 : 1.0 / walk.dirSteps.x, dir.y == 0.0 ? 1e30 : 1.0 / walk.dirSteps.y,
                           dir.z == 0.0 ? 1e30 : 1.0 / walk.dirSteps.z);
  return walk;
}

// Half steps first: the distance across the root is 2^32 steps and more than an int holds.
uvec3 walkTo(Walk walk, float t) { return walk.origin + (uvec3(ivec3(walk.dirSteps * (0.5 * t))) << 1u); }

// How far behind a cell's exit the next look-up is made. p is exact to two steps plus the rounding of t (2^-23 t an axis); four times
// that moves past the face for certain. Metres.
float pastExit(float t) { return 8.0 * tree.stepLength_m + 5e-7 * t; }
