#pragma once
// A ball of cloud for tests: full inside, falling to nothing over the outer tenth of its radius, or over a voxel where that is wider.
#include "welkin/shared/octree.glsl.h"
WK_BEGIN
struct SphereParams {
  uint centreX;
  uint centreY;
  uint centreZ;
  float radius_steps;
  float extinction_per_m;
};

// Extinction in 1/m.
WK_FN float sphereDensity(SphereParams s, uvec3 p, uint level) {
  float x = float(max(p.x, s.centreX) - min(p.x, s.centreX)), y = float(max(p.y, s.centreY) - min(p.y, s.centreY));
  float z = float(max(p.z, s.centreZ) - min(p.z, s.centreZ));
  float edge = max(F(0.1) * s.radius_steps, levelSteps(level) * F(0.142857142));
  // the edge is centred on 0.95 radii, so that a wider one neither grows nor shrinks the ball
  float d = F(0.95) * s.radius_steps + F(0.5) * edge - sqrt(x * x + y * y + z * z);
  return s.extinction_per_m * clamp(d / edge, F(0.0), F(1.0));
}
WK_END
