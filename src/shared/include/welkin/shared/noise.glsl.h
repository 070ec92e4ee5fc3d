#pragma once
// Gradient noise on fixed-point octree coordinates. The lattice is bits of the position and the hash is integers, so it is as random
// at the last octave as at the first, and CPU and GPU see the same lattice; the float part is + - * min max only.
#include "welkin/shared/prelude.glsl.h"
WK_BEGIN

// The raw sum (gradient components uniform on [-1, 1], variance 1/3; quintic fade f) has variance A B^2 with
// A = 2 int f^2 (1-t)^2 = 535/9009 and B = 2 int f^2 = 181/231 over 0..1; 1023 gradient steps instead of a continuum make it 0.2 %
// more. Three of its standard deviations are 1: noise = clamp(raw / (3 sigma), -1, 1). Without the clamp the range would be
// +-1.5 / (3 sigma); the share of clamped places is about 1e-3, so it is not seen and bounds become 2.6 times as tight.
WK_CONST float kNoiseRawSigma = F(0.19113);
WK_CONST float kNoiseScale = F(1.0) / (F(3.0) * kNoiseRawSigma * F(511.5));
// Greatest |d noise / d axis| in 1/cell: 4.625 before scaling. For one axis the extreme choice of all gradients gives
// sum |w + w' d| + sum |w'| (a(y) + a(z)), a = sum w |d| <= 1/2, w' <= 15/8: at the middle 7/8 + 15/4.
WK_CONST float kNoiseLipschitz = F(4.625) / (F(3.0) * kNoiseRawSigma);
// Standard deviation of the clamped noise, and mean and standard deviation of its absolute value (measured over 1e7 points; the
// property test measures them again).
WK_CONST float kNoiseSigma = F(0.3330);
WK_CONST float kNoiseAbsMean = F(0.2678);
WK_CONST float kNoiseAbsSigma = F(0.1980);
// |noise| - mean has a smaller spread than noise: this brings it back to about the same.
WK_CONST float kBillowScale = F(1.5);

WK_FN uint mixBits(uint v) {
  uint h = v;
  h ^= h >> 16u;
  h *= 0x7FEB352Du;
  h ^= h >> 15u;
  h *= 0x846CA68Bu;
  h ^= h >> 16u;
  return h;
}

WK_FN float noiseFade(float t) { return t * t * t * (t * (t * F(6.0) - F(15.0)) + F(10.0)); }

// Position inside a cell of 2^shift steps, 0..1, exact: bits below 2^-24 of a cell are dropped.
WK_FN float cellFraction(uint p, uint shift) {
  uint drop = shift > 24u ? shift - 24u : 0u;
  uint keep = shift - drop;
  return float(int((p >> drop) & ((1u << keep) - 1u))) * uintBitsToFloat((127u - keep) << 23u);
}

// Gradient (times 511.5) of the hash, dotted with the offset.
WK_FN float gradientDot(uint h, float x, float y, float z) {
  return (float(int(h & 1023u)) - F(511.5)) * x + (float(int((h >> 10u) & 1023u)) - F(511.5)) * y + (float(int(h >> 22u)) - F(511.5)) * z;
}

// The hash's input of one lattice plane per axis. The lattice wraps with the root cube, so a position that a warp pushed over the
// edge goes on smoothly.
WK_FN uint latticeX(uint p, uint shift, uint next) { return (((p >> shift) + next) & (0xFFFFFFFFu >> shift)) * 0x8DA6B343u; }
WK_FN uint latticeY(uint p, uint shift, uint next) { return (((p >> shift) + next) & (0xFFFFFFFFu >> shift)) * 0xD8163841u; }
WK_FN uint latticeZ(uint p, uint shift, uint next) { return (((p >> shift) + next) & (0xFFFFFFFFu >> shift)) * 0xCB1AB31Fu; }

// A lattice plane of noise at one x and y: the blended gradients' value at the plane, and their slope along z.
struct NoisePlane {
  float value;
  float slope;
};
WK_FN NoisePlane noisePlane(uint h00, uint h10, uint h01, uint h11, float x, float y, float fx, float fy, uint hz) {
  uint a = mixBits(h00 ^ hz), b = mixBits(h10 ^ hz), c = mixBits(h01 ^ hz), d = mixBits(h11 ^ hz);
  float x1 = x - F(1.0), y1 = y - F(1.0);
  float va = gradientDot(a, x, y, F(0.0)), vb = gradientDot(b, x1, y, F(0.0)), vc = gradientDot(c, x, y1, F(0.0)), vd = gradientDot(d, x1, y1, F(0.0));
  float sa = float(int(a >> 22u)), sb = float(int(b >> 22u)), sc = float(int(c >> 22u)), sd = float(int(d >> 22u));
  float v0 = va + fx * (vb - va), v1 = vc + fx * (vd - vc), s0 = sa + fx * (sb - sa), s1 = sc + fx * (sd - sc);
  return WK_NEW(NoisePlane, v0 + fy * (v1 - v0), s0 + fy * (s1 - s0) - F(511.5));
}

// Noise -1..1 with cells of 2^shift steps along x and y and 2^zShift along z; shifts 1..31. Along z last, in the order in which columns of
// samples are made (cloud_column.glsl.h), so that both agree to the last bits.
WK_FN float noise3(uvec3 p, uint shift, uint zShift, uint seed) {
  float x = cellFraction(p.x, shift), y = cellFraction(p.y, shift), z = cellFraction(p.z, zShift);
  float fx = noiseFade(x), fy = noiseFade(y);
  uint hx0 = latticeX(p.x, shift, 0u) ^ seed, hx1 = latticeX(p.x, shift, 1u) ^ seed;
  uint hy0 = latticeY(p.y, shift, 0u), hy1 = latticeY(p.y, shift, 1u);
  uint h00 = hx0 ^ hy0, h10 = hx1 ^ hy0, h01 = hx0 ^ hy1, h11 = hx1 ^ hy1;
  NoisePlane low = noisePlane(h00, h10, h01, h11, x, y, fx, fy, latticeZ(p.z, zShift, 0u));
  NoisePlane high = noisePlane(h00, h10, h01, h11, x, y, fx, fy, latticeZ(p.z, zShift, 1u));
  float a = low.value + low.slope * z, b = high.value + high.slope * (z - F(1.0));
  return clamp((a + noiseFade(z) * (b - a)) * kNoiseScale, F(-1.0), F(1.0));
}

// Blend from plain noise to billows, |n| - E|n|: round lumps that meet in sharp creases. The mean stays 0.
WK_FN float billowNoise(float n, float billow) { return n + billow * (kBillowScale * (abs(n) - kNoiseAbsMean) - n); }

WK_FN uint octaveSeed(uint seed, uint octave) { return seed + octave * 0x9E3779B9u; }

WK_END
