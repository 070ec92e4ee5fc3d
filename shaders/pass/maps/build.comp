// One work group refreshes 4^3 cells of one octree map: per cell the deepest resident node down to the map's level, or the highest
// empty one, found by descent from the root.
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/tree_block.glsl.h"

layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;
layout(std140, binding = WK_TREE_BINDING) uniform TreeUniforms { TreeBlock tree; };
layout(std430, binding = WK_NODES_BINDING) readonly buffer NodeBuffer { uvec2 nodes[]; };
layout(std430, binding = WK_MAP_JOBS_BINDING) readonly buffer Jobs { uvec4 jobs[]; };  // first cell, level
layout(rg32ui, binding = 0) uniform writeonly uimage3D u_mapImage;
uniform uint u_firstJob;

void main() {
  uvec4 job = jobs[u_firstJob + gl_WorkGroupID.x];
  uvec3 cell = job.xyz + gl_LocalInvocationID;
  uint level = job.w;
  uvec3 p = cell << (32u - level);
  uvec2 node = nodes[0];
  uint at = 0u, brick = wordBrick(node.x);
  while (at < level && node.y != kNoGroup && !wordEmpty(node.x)) {
    node = nodes[node.y + childOctant(p, at)];
    at++;
    brick = wordBrick(node.x);
  }
  bool empty = wordEmpty(node.x);
  uint group = at == level && !empty ? node.y : kNoGroup;
  uvec4 entry = uvec4(packWord(empty ? kZeroBrick : brick, wordMaxCode(node.x), at), group, 0u, 0u);
  imageStore(u_mapImage, ivec3(cell.x & 63u, cell.y & 63u, (cell.z & 63u) + (level - tree.mapBase) * 64u), entry);
}
