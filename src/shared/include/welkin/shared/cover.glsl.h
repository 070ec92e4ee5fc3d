#pragma once
// Cover on six cube faces. Face order +X -X +Y -Y +Z -Z; on a face of axis a the coordinates are the components a+1 and a+2 (cyclic)
// over |component a|, -1..1. A face stores one border texel all round: copies of the neighbour's edge row, texel for texel. Half a
// texel off an edge both faces then blend the same two rows with the same weights, so value and slope go on across the seam
// (within a texel of the eight corners the value alone).
#include "welkin/shared/cloud_source.glsl.h"
WK_BEGIN

struct CoverPlace {
  uint face;
  double u;  // 0..1 across the face
  double v;
};

WK_FN uint magnitude(uint p) { return p >= 0x80000000u ? p - 0x80000000u : 0x80000000u - p; }

// Where the direction from the root's centre to p meets the faces. The one division is in double: in float it would move the
// place by 1e-4 texels between GPUs.
WK_FN CoverPlace coverPlace(uvec3 p) {
  uint ax = magnitude(p.x), ay = magnitude(p.y), az = magnitude(p.z);
  uint along = p.x, first = p.y, second = p.z, axis = 0u, length0 = ax;
  if (ay > ax && ay >= az) {
    along = p.y;
    first = p.z;
    second = p.x;
    axis = 1u;
    length0 = ay;
  } else if (az > ax) {
    along = p.z;
    first = p.x;
    second = p.y;
    axis = 2u;
    length0 = az;
  }
  double scale = double(F(0.5)) / double(max(length0, 1u));
  CoverPlace place;
  place.face = axis * 2u + (along >= 0x80000000u ? 0u : 1u);
  place.u = (double(first) - double(F(2147483648.0))) * scale + double(F(0.5));
  place.v = (double(second) - double(F(2147483648.0))) * scale + double(F(0.5));
  return place;
}

// Three neighbouring bytes of the cover, starting at byte `at`, as the low 24 bits.
WK_FN uint coverTriple(WK_SOURCE_PARAM uint base, uint at) {
  uint shift = (at & 3u) * 8u;
  uint low = WK_COVER_WORD(base + (at >> 2u));
  uint high = WK_COVER_WORD(base + (at >> 2u) + 1u);
  return (low >> shift) | ((high << (31u - shift)) << 1u);
}

WK_FN float coverRow(uint triple, float w0, float w1, float w2) {
  return float(int(triple & 255u)) * w0 + float(int((triple >> 8u) & 255u)) * w1 + float(int((triple >> 16u) & 255u)) * w2;
}

// Bytes from one row of a face of `edge` texels to the next: two border texels and two of padding.
WK_FN uint coverStride(uint edge) { return edge + 4u; }

// Cover 0..1 at a place: quadratic B-spline of 3 x 3 texels, once continuously differentiable, never outside their range.
WK_FN float coverAt(WK_SOURCE_PARAM CoverPlace place, uint mip) {
  uint edge = WK_HEADER.coverEdge[mip];
  double u = place.u * double(edge), v = place.v * double(edge);
  uint i = min(uint(max(int(u), 0)), edge - 1u), j = min(uint(max(int(v), 0)), edge - 1u);
  float x = float(u - double(i)), y = float(v - double(j));
  float x0 = F(0.5) * (F(1.0) - x) * (F(1.0) - x), x2 = F(0.5) * x * x, x1 = F(1.0) - x0 - x2;
  float y0 = F(0.5) * (F(1.0) - y) * (F(1.0) - y), y2 = F(0.5) * y * y, y1 = F(1.0) - y0 - y2;
  uint stride = coverStride(edge), base = WK_HEADER.coverOffset[mip];
  uint at = (place.face * (edge + 2u) + j) * stride + i;
  float sum = coverRow(coverTriple(WK_SOURCE_ARG base, at), x0, x1, x2) * y0 +
              coverRow(coverTriple(WK_SOURCE_ARG base, at + stride), x0, x1, x2) * y1 +
              coverRow(coverTriple(WK_SOURCE_ARG base, at + 2u * stride), x0, x1, x2) * y2;
  return sum * F(0.003921568627);
}

WK_END
