// Test: shared addressing, walking and level-of-detail functions on the GPU, one row of answers for each row of inputs.
#include "welkin/shared/sun_depth.glsl.h"
#include "welkin/shared/tree_block.glsl.h"
#include "welkin/shared/walk.glsl.h"
layout(local_size_x = 64) in;
struct Row {
  uvec4 place;  // position, level 0..23
  vec4 ray;     // unit direction, distance in metres
  vec4 other;   // 0..1 each
};
layout(std430, binding = 0) readonly buffer Inputs { Row rows[]; };
layout(std430, binding = 1) writeonly buffer Answers { uint answers[]; };
uniform float u_stepsPerMetre;

void main() {
  uint row = gl_GlobalInvocationID.x, o = 48u * row;
  uvec3 p = rows[row].place.xyz;
  uint level = rows[row].place.w;
  vec3 dir = rows[row].ray.xyz;
  float t = rows[row].ray.w;
  vec4 x = rows[row].other;
  uvec3 corner = nodeCorner(p, level), child = childCorner(corner, level, p.x & 7u);
  uvec3 s = brickSample(corner, level, p & 7u);
  uint word = packWord(p.x & kBrickMask, p.y & 31u, level);
  uint integers[20] = uint[20](corner.x, corner.y, corner.z, childOctant(p, level), child.x, child.y, child.z, s.x, s.y, s.z, word,
    wordBrick(word), wordMaxCode(word), wordLevel(word), uint(wordEmpty(word)), mapLevelAt(exp2(x.x * 20.0), 6u, 16u),
    detailAt(x.y * 70000.0, 16u).level, mapEntry(p >> (32u - max(level, 6u)), max(level, 6u), 6u), brickTexel(p.x & kBrickMask).z, levelMask(level));
  for (uint i = 0u; i < 20u; ++i) answers[o + i] = integers[i];
  Walk walk = startWalk(dvec3(p) + 0.5, dir, u_stepsPerMetre);
  uvec3 to = walkTo(walk, t);
  vec3 local = nodeLocal(p, level);
  float floats[20] = float[20](walk.dirSteps.x, walk.dirSteps.y, walk.dirSteps.z, nodeExit(nodeSteps(p, level), levelSteps(level), step(0.0, dir), (2.0 * step(0.0, dir) - 1.0) * x.xyz * 1e6),
    local.x, local.y, local.z, walkError(t, x.x), leaveNode(walk, nodeSteps(p, level), levelSteps(level), t, x.x + 0.01), levelSteps(level), detailAt(x.y * 70000.0, 16u).parentWeight,
    uintBitsToFloat(walk.origin.x), uintBitsToFloat(to.x), uintBitsToFloat(to.y), uintBitsToFloat(to.z), walk.metrePerStep.x, walk.metrePerStep.y,
    encodeDepth(x.z * 200.0), decodeDepth(x.w), maxCodeValue(p.y & 31u));
  for (uint i = 0u; i < 20u; ++i) answers[o + 20u + i] = floatBitsToUint(floats[i]);
}
