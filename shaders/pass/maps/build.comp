// One work group refreshes 4^3 cells of one octree map: per cell the deepest resident node down to the map's level, or the highest
// empty one, found by descent from the root.
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/tree_block.glsl.h"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(std140, binding = WK_TREE_BINDING) uniform TreeUniforms { TreeBlock tree; };
layout(std430, binding = WK_NODES_BINDING) buffer NodeBuffer { uvec2 words[]; };
layout(std430, binding = WK_MAP_JOBS_BINDING) readonly buffer Jobs { uvec4 jobs[]; };  // first cell, level
uniform uint u_firstJob;

void main() {
  uvec4 job = jobs[u_firstJob + gl_WorkGroupID.x];
  uvec3 cell = job.xyz + gl_LocalInvocationID;
  uint level = job.w;
  uvec3 p = cell << (32u - level);
  uvec2 node = words[tree.firstNode];
  uint at = 0u, brick = wordBrick(node.x);
  while (at < level && node.y != kNoGroup && !wordEmpty(node.x)) {
    node = words[tree.firstNode + node.y + childOctant(p, at)];
    at++;
    brick = wordBrick(node.x);
  }
  bool empty = wordEmpty(node.x);
  uint group = at == level && !empty ? node.y : kNoGroup;
  words[mapEntry(cell, level, tree.mapBase)] = uvec2(packWord(empty ? kZeroBrick : brick, wordMaxCode(node.x), at), group);
}
