#pragma once
// Walking a straight ray through the octree: fixed point at its start plus a float distance, cell by cell.
#include "welkin/shared/camera.glsl.h"
#include "welkin/shared/octree.glsl.h"
WK_BEGIN

struct Walk {
  uvec3 origin;       // start of the ray
  vec3 dirSteps;      // fixed-point steps a metre
  vec3 metrePerStep;  // reciprocal; huge where a component is 0
  vec3 ahead;         // 1 where the direction is not negative, else 0
};

// `startSteps`: the start in fixed-point steps, fp64, clamped to the root. `dir` unit, planet frame.
WK_FN Walk startWalk(dvec3 startSteps, vec3 dir, float stepsPerMetre) {
  vec3 d = dir * stepsPerMetre;
  dvec3 s = dvec3(clamp(startSteps.x, WK_D(0.0), WK_D(4294967295.0)), clamp(startSteps.y, WK_D(0.0), WK_D(4294967295.0)),
                  clamp(startSteps.z, WK_D(0.0), WK_D(4294967295.0)));
  return WK_NEW(Walk, uvec3(uint(s.x), uint(s.y), uint(s.z)), d,
                vec3(d.x == F(0.0) ? F(1e30) : F(1.0) / d.x, d.y == F(0.0) ? F(1e30) : F(1.0) / d.y, d.z == F(0.0) ? F(1e30) : F(1.0) / d.z),
                vec3(d.x < F(0.0) ? F(0.0) : F(1.0), d.y < F(0.0) ? F(0.0) : F(1.0), d.z < F(0.0) ? F(0.0) : F(1.0)));
}

// Position at distance t, modulo the root. In half steps, because the way across the root is 2^32 steps and more than an int holds.
WK_FN uvec3 walkTo(Walk walk, float t) {
  vec3 h = walk.dirSteps * (F(0.5) * t);
  return walk.origin + uvec3(uint(int(h.x)) << 1u, uint(int(h.y)) << 1u, uint(int(h.z)) << 1u);
}

// An axis of walkTo is off by at most three steps (truncation to half steps, start) and 2^-22 t (roundings of direction, product and t).
WK_FN float walkError(float t, float step_m) { return F(3.0) * step_m + F(2.5e-7) * t; }

// Distance from t, at `steps` inside a node of `size`, to where the ray is behind the node by twice the error of its position, measured across
// the face: there the next look-up finds another node, be the ray as flat as it will. Measured along the ray, one that starts on a face
// and hardly leaves it would be looked up every few centimetres. No node is left out that is thicker than that.
WK_FN float leaveNode(Walk walk, vec3 steps, float size, float t, float step_m) {
  float slack = F(2.0) * walkError(t, step_m) / step_m;
  return nodeExit(steps + slack, size + F(2.0) * slack, walk.ahead, walk.metrePerStep);
}

WK_END
