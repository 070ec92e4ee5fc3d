#pragma once
// Fixed-point octree addressing. The root cube has 2^32 steps an axis; a position is a uvec3, a node is (corner, level) with
// its size 2^(32-level) steps. Everything here is bit tests: no chain of float subtractions (DESIGN, Precision).
#include "welkin/shared/prelude.glsl.h"
WK_BEGIN

WK_CONST uint kMaxDepth = 24u;
WK_CONST uint kBrickEdge = 8u;             // corner samples an axis
WK_CONST uint kBrickCells = 7u;            // cells an axis
WK_CONST uint kNoGroup = 0xFFFFFFFFu;      // a node without children
WK_CONST uint kZeroBrick = 0u;             // brick 0 is resident from the start and holds zeros
WK_CONST uint kBrickBits = 22u;            // 4 Mi bricks = 8 GiB
WK_CONST uint kBrickMask = 0x3FFFFFu;
WK_CONST uint kMapShift = 6u;              // an octree map has 64^3 cells
WK_CONST uint kMapEdge = 64u;

// A node as the GPU stores it, and a map entry: `word` packs the brick (22 bits), the maximum of the resident subtree as a code
// (5 bits, 0 = empty) and a level (5 bits: in a map entry the level of the node that the word describes; 0 in the node buffer).
// `group` is the index of the first of eight children, or kNoGroup.
struct NodeWords {
  uint word;
  uint group;
};

WK_FN uint packWord(uint brick, uint maxCode, uint level) { return brick | (maxCode << 22u) | (level << 27u); }
WK_FN uint wordBrick(uint word) { return word & kBrickMask; }
WK_FN uint wordMaxCode(uint word) { return (word >> 22u) & 31u; }
WK_FN uint wordLevel(uint word) { return word >> 27u; }
WK_FN bool wordEmpty(uint word) { return wordMaxCode(word) == 0u; }

// Upper bound that a code stands for, as a fraction of the source's greatest extinction: code c in 1..31 is 2^(-(31-c)/2), made of
// its bits: the exponent, and a factor sqrt(1/2) (rounded up) where 31 - c is odd.
WK_FN float maxCodeValue(uint code) {
  uint below = 31u - code;
  float value = uintBitsToFloat((127u - (below >> 1u)) << 23u) * ((below & 1u) == 1u ? F(0.70710683) : F(1.0));
  return code == 0u ? F(0.0) : value;
}

// All positions of a node of this level share the bits above this mask. (32-bit shift by the level: level 0 gives all ones.)
WK_FN uint levelMask(uint level) { return 0xFFFFFFFFu >> level; }

// Node size in steps, 2^(32 - level), and its reciprocal. Exact: the exponent's bits.
WK_FN float levelSteps(uint level) { return uintBitsToFloat((159u - level) << 23u); }
WK_FN float levelStepsInverse(uint level) { return uintBitsToFloat((95u + level) << 23u); }

WK_FN uvec3 nodeCorner(uvec3 p, uint level) { return p & uvec3(~levelMask(level)); }

// Which of its eight children a node of `level` has position p in: bit 0 x, bit 1 y, bit 2 z.
WK_FN uint childOctant(uvec3 p, uint level) {
  uint s = 31u - level;
  return ((p.x >> s) & 1u) | (((p.y >> s) & 1u) << 1u) | (((p.z >> s) & 1u) << 2u);
}

WK_FN uvec3 childCorner(uvec3 corner, uint level, uint octant) {
  uint s = 31u - level;
  return corner + uvec3((octant & 1u) << s, ((octant >> 1u) & 1u) << s, ((octant >> 2u) & 1u) << s);
}

// Position of corner sample i (0..7 an axis) of a brick: corner + floor(i * size / 7), the same for the neighbour that shares it.
// size = 7 q + r keeps the product inside 32 bits. The far corner of the last node of the root saturates at 2^32 - 1.
WK_FN uint brickSampleStep(uint i, uint level) {
  uint mask = levelMask(level);  // size - 1
  uint q = mask / 7u;
  uint r = mask - q * 7u + 1u;   // size = 7 q + r, r in 1..7
  return i * q + (i * r) / 7u;
}
WK_FN uint saturatingAdd(uint a, uint b) { return a > 0xFFFFFFFFu - b ? 0xFFFFFFFFu : a + b; }
WK_FN uvec3 brickSample(uvec3 corner, uint level, uvec3 i) {
  return uvec3(saturatingAdd(corner.x, brickSampleStep(i.x, level)), saturatingAdd(corner.y, brickSampleStep(i.y, level)),
               saturatingAdd(corner.z, brickSampleStep(i.z, level)));
}

// Position of p inside its node of `level`, in steps. Exact below 2^24, rounded above.
WK_FN vec3 nodeSteps(uvec3 p, uint level) {
  uvec3 lo = p & uvec3(levelMask(level));
  return vec3(float(lo.x), float(lo.y), float(lo.z));
}

// Distance from there to the far side of the node: per axis the face ahead is at 0 or at `size`. `ahead` is 1 where the direction is not
// negative, else 0; `perStep` the distance a step, signed, huge where the direction is 0 (walk.glsl.h). Never negative.
WK_FN float nodeExit(vec3 steps, float size, vec3 ahead, vec3 perStep) {
  vec3 t = (ahead * size - steps) * perStep;
  return min(t.x, min(t.y, t.z));
}

// Coordinate of p inside its node of `level`, 0..1 an axis.
WK_FN vec3 nodeLocal(uvec3 p, uint level) { return nodeSteps(p, level) * levelStepsInverse(level); }

WK_END
