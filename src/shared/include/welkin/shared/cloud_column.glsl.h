#pragma once
// The same density as layersDensity(), for the eight samples of one column of a brick at once: along z a noise cell is two lattice planes
// whose four gradients each are blended once, so an octave costs two to five half noises a column instead of eight whole ones. Up to rounding
// (1e-6 of a noise) the values are those of single points; a unit test compares them. Loops are tested at their end: software GL runs
// the body of any branch, and of a loop until its first test.
#include "welkin/shared/cloud_layers.glsl.h"
WK_BEGIN

struct Column8 {
  float v[8];
};

// Adds amplitude * billow(noise) of one octave to a column that starts at p and has its samples `steps` further along z. The least cell is a
// quarter of the brick, so the column meets 1, 2 or 4 of them.
WK_FN Column8 addOctave(Column8 sum, uvec3 p, Column8 steps, uint sizeShift, uint shift, uint zShift, uint seed, float amplitude, float billow) {
  uint cells = sizeShift > zShift ? 1u << min(sizeShift - zShift, 2u) : 1u;
  float x = cellFraction(p.x, shift), y = cellFraction(p.y, shift), z = cellFraction(p.z, zShift);
  float fx = noiseFade(x), fy = noiseFade(y);
  uint hx0 = latticeX(p.x, shift, 0u) ^ seed, hx1 = latticeX(p.x, shift, 1u) ^ seed;
  uint hy0 = latticeY(p.y, shift, 0u), hy1 = latticeY(p.y, shift, 1u);
  uint h00 = hx0 ^ hy0, h10 = hx1 ^ hy0, h01 = hx0 ^ hy1, h11 = hx1 ^ hy1;
  float inv = uintBitsToFloat((127u - zShift) << 23u);
  NoisePlane low = noisePlane(h00, h10, h01, h11, x, y, fx, fy, latticeZ(p.z, zShift, 0u));
  uint cell = 0u;
  float plain = amplitude * (F(1.0) - billow), lumps = amplitude * billow * kBillowScale;
  do {
    NoisePlane high = noisePlane(h00, h10, h01, h11, x, y, fx, fy, latticeZ(p.z, zShift, cell + 1u));
    for (uint k = 0u; k < 8u; ++k) {
      float w = z + steps.v[k] * inv - float(int(cell));
      float a = low.value + low.slope * w, b = high.value + high.slope * (w - F(1.0));
      float n = clamp((a + noiseFade(w) * (b - a)) * kNoiseScale, F(-1.0), F(1.0));
      float add = plain * n + lumps * (abs(n) - kNoiseAbsMean);
      sum.v[k] += ((k * cells) >> 3u) == cell ? add : F(0.0);
    }
    low = high;
  } while (++cell < cells);
  return sum;
}

// The same for a warped layer, whose samples are not on a line.
WK_FN Column8 addWarpedOctaves(WK_SOURCE_PARAM uint layer, uvec3 p, Column8 steps, uint octaves) {
  Column8 sum;
  uint shift = WK_LAYER(layer).shift, streak = WK_LAYER(layer).streak, seed = WK_LAYER(layer).seed;
  float billow = WK_LAYER(layer).billow, gain = WK_LAYER(layer).gain;
  uint k = 0u;
  do {
    uvec3 q = warpedPosition(WK_SOURCE_ARG layer, uvec3(p.x, p.y, saturatingAdd(p.z, uint(steps.v[k]))));
    float amplitude = WK_LAYER(layer).amplitude, n = F(0.0);
    uint octave = 0u;
    do {
      n += amplitude * billowNoise(noise3(q, shift - octave, shift - octave - streak, octaveSeed(seed, octave)), billow);
      amplitude *= gain;
    } while (++octave < octaves);
    sum.v[k] = n;
  } while (++k < 8u);
  return sum;
}

// Greater densities of one layer in a column from p; `cover` and `type` at its samples, `height` the magnitudes of their altitudes.
WK_FN Column8 layerColumn(WK_SOURCE_PARAM Column8 density, uint layer, uvec3 p, uint level, Column8 steps, Column8 height, Column8 cover, Column8 type) {
  LayerAt a = layerAt(WK_SOURCE_ARG layer, level);
  Column8 c, profile, threshold, n;
  float coverGain = WK_LAYER(layer).coverGain, coverBias = WK_LAYER(layer).coverBias;
  bool typed = WK_LAYER(layer).typed != 0u;
  float typeLow = WK_LAYER(layer).typeLow, typeHigh = WK_LAYER(layer).typeHigh;
  float riseLow = WK_LAYER(layer).typeInvRiseLow, riseHigh = WK_LAYER(layer).typeInvRiseHigh;
  for (uint k = 0u; k < 8u; ++k) {
    float weight = min(clamp((type.v[k] - typeLow) * riseLow, F(0.0), F(1.0)), clamp((typeHigh - type.v[k]) * riseHigh, F(0.0), F(1.0)));
    c.v[k] = clamp(cover.v[k] * coverGain + coverBias, F(0.0), F(1.0)) * (typed ? weight : F(1.0));
    LayerPlace place = layerPlace(a, height.v[k], c.v[k], thresholdOf(WK_SOURCE_ARG layer, c.v[k]));
    profile.v[k] = place.profile;
    threshold.v[k] = place.threshold;
    n.v[k] = F(0.0);
  }
  uint octaves = WK_LAYER(layer).octaves[level], shift = WK_LAYER(layer).shift, streak = WK_LAYER(layer).streak, seed = WK_LAYER(layer).seed;
  if (WK_LAYER(layer).warp_steps > F(0.0)) {
    if (octaves > 0u) n = addWarpedOctaves(WK_SOURCE_ARG layer, p, steps, octaves);
    octaves = 0u;
  }
  float billow = WK_LAYER(layer).billow, gain = WK_LAYER(layer).gain, amplitude = WK_LAYER(layer).amplitude;
  float rest = WK_LAYER(layer).shown[level], perRest = WK_LAYER(layer).restHigh * a.invSoftness;
  if (octaves == 0u) amplitude = F(0.0);
  uint octave = 0u;
  bool open = false;
  do {
    n = addOctave(n, p, steps, 32u - level, shift - octave, shift - octave - streak, octaveSeed(seed, octave), amplitude, billow);
    rest -= amplitude;
    amplitude *= gain;
    ++octave;
    // any sample that later octaves can still move?
    float room = rest * perRest + a.spread;
    open = false;
    for (uint k = 0u; k < 8u; ++k) {
      float x0 = (n.v[k] - threshold.v[k]) * a.invSoftness;
      open = open || (profile.v[k] > F(0.0) && x0 + room > F(0.0) && x0 - room < F(1.0));
    }
    open = open && octave < octaves;
  } while (open);
  for (uint k = 0u; k < 8u; ++k) {
    LayerPlace place = WK_NEW(LayerPlace, profile.v[k], threshold.v[k]);
    density.v[k] = max(density.v[k], layerValue(a, place, c.v[k], n.v[k]));
  }
  return density;
}

// Can the layer be in a node whose altitudes (magnitudes) and weather lie in these ranges?
WK_FN bool layerReaches(WK_SOURCE_PARAM uint layer, uint level, float low_m, float high_m, float coverHigh, float typeLow, float typeHigh) {
  float base = WK_LAYER(layer).base_m, reach = F(0.5) * (WK_LAYER(layer).filter_m[level] + WK_LAYER(layer).blur_m[level]);
  float gain = WK_LAYER(layer).coverGain, bias = WK_LAYER(layer).coverBias;
  bool inType = WK_LAYER(layer).typed == 0u || (typeHigh > WK_LAYER(layer).typeLow && typeLow < WK_LAYER(layer).typeHigh);
  return inType && high_m + reach > base && low_m - reach < base + WK_LAYER(layer).thickness_m && max(coverHigh * gain, F(0.0)) + bias > F(0.0);
}

WK_END
