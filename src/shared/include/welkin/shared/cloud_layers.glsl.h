#pragma once
// Density of layered procedural clouds at a fixed-point position, band-limited to the voxel of a level.
//
// A layer is cloud where noise exceeds a threshold that its cover sets. What a level cannot show is replaced by its expectation:
// octaves finer than the voxel by the mean of the threshold's ramp over them, the height profile by its mean over the voxel, so
// that optical depth survives on every level; and clumps finer than the voxel by what they let through (clumping). Integers, + - * min max, one division per layer whose top follows the cover, one
// division and one root for the altitude; no exp, sin or pow.
#include "welkin/shared/cloud_source.glsl.h"
#include "welkin/shared/cover.glsl.h"
#include "welkin/shared/noise.glsl.h"
WK_BEGIN

// Altitude of p in metres, negative below the ground: (|x|^2 - R^2) / (|x| + R), the difference in double because it cancels.
// Error below 0.03 m within 100 km of an Earth's ground.
WK_FN float cloudAltitude(WK_SOURCE_PARAM uvec3 p) {
  double half0 = double(F(2147483648.0));
  double x = double(p.x) - half0, y = double(p.y) - half0, z = double(p.z) - half0;
  double r2 = x * x + y * y + z * z;
  float excess = float(r2 - doubleFromWords(WK_HEADER.radius2Low, WK_HEADER.radius2High));
  return excess / (sqrt(float(r2)) + WK_HEADER.radius_steps) * WK_HEADER.step_m;
}

// Weather type 0 (stratiform) to 1 (convective): two octaves of continental noise, and the tropics lean to convection.
WK_FN float typeFromNoise(float n0, float n1, float sinLatitude2) {
  return clamp(F(0.58) + F(0.62) * n0 + F(0.4) * n1 - F(0.3) * sinLatitude2, F(0.0), F(1.0));
}
WK_FN float cloudType(WK_SOURCE_PARAM uvec3 p) {
  uint shift = WK_HEADER.typeShift, seed = WK_HEADER.seed;
  float x = float(int(p.x ^ 0x80000000u)), y = float(int(p.y ^ 0x80000000u)), z = float(int(p.z ^ 0x80000000u));
  float z2 = z * z;
  float r2 = max(x * x + y * y + z2, F(1.0));
  return typeFromNoise(noise3(p, shift, shift, seed), noise3(p, shift - 1u, shift - 1u, octaveSeed(seed, 1u)), z2 / r2);
}

// Cover and weather type change slowly: a node knows them on a lattice of 4^3 points, and in between they are trilinear.
struct Weather {
  float cover;
  float type;
};
WK_FN uvec3 weatherPoint(uvec3 corner, uint level, uvec3 i) {
  uint size = levelMask(level);  // a step short of the node's size: the last point then stays inside the root cube
  uvec3 at = i * (size / 3u);
  return uvec3(saturatingAdd(corner.x, i.x == 3u ? size : at.x), saturatingAdd(corner.y, i.y == 3u ? size : at.y),
               saturatingAdd(corner.z, i.z == 3u ? size : at.z));
}
WK_FN float cloudCover(WK_SOURCE_PARAM uvec3 p, uint level) {
  float cover = F(1.0);
  if (WK_HEADER.coverMips > 0u) cover = coverAt(WK_SOURCE_ARG coverPlace(p), WK_HEADER.coverMip[level]);
  return cover;
}
WK_FN Weather weatherAt(WK_SOURCE_PARAM uvec3 p, uint level) {
  return WK_NEW(Weather, cloudCover(WK_SOURCE_ARG p, level), cloudType(WK_SOURCE_ARG p));
}
// Mean of clamp(x, 0, 1) over [a, b], a < b. Exactly 0 or 1 where that is constant.
WK_FN float rampMean(float a, float b) {
  float ca = clamp(a, F(0.0), F(1.0)), cb = clamp(b, F(0.0), F(1.0));
  return (F(0.5) * (cb - ca) * (cb + ca) + (max(b, F(1.0)) - max(a, F(1.0)))) / (b - a);
}

// What the density of one layer needs at one level.
struct LayerAt {
  float base_m, thickness_m, invThickness, baseFade_m, invBaseFade, topFade_m, invTopFade;
  float filter_m, blur_m, spread, invSpread2, clump;
  float extinction_per_m, invSoftness, taper, topFollowsCover;
};
WK_FN LayerAt layerAt(WK_SOURCE_PARAM uint layer, uint level) {
  return WK_NEW(LayerAt, WK_LAYER(layer).base_m, WK_LAYER(layer).thickness_m, WK_LAYER(layer).invThickness,
                WK_LAYER(layer).baseFade_m, WK_LAYER(layer).invBaseFade, WK_LAYER(layer).topFade_m, WK_LAYER(layer).invTopFade,
                WK_LAYER(layer).filter_m[level], WK_LAYER(layer).blur_m[level], WK_LAYER(layer).spread[level], WK_LAYER(layer).invSpread2[level],
                WK_LAYER(layer).clump[level], WK_LAYER(layer).extinction_per_m, WK_LAYER(layer).invSoftness, WK_LAYER(layer).taper,
                WK_LAYER(layer).topFollowsCover);
}

// Mean of the trapezoid profile over [low, high], metres above the base: it rises and falls in turn, so it is rise + fall - 1.
WK_FN float profileMean(LayerAt a, float low, float high) {
  if (high <= F(0.0) || low >= a.thickness_m) return F(0.0);
  return max(rampMean(low * a.invBaseFade, high * a.invBaseFade) +
             rampMean((a.thickness_m - high) * a.invTopFade, (a.thickness_m - low) * a.invTopFade) - F(1.0), F(0.0));
}

// Second antiderivative of clamp(z / fade, 0, 1), and of the trapezoid profile: above the layer that is its area times the height over its
// centroid, without the squares that would cancel.
WK_FN float rampArea(float z, float fade, float invFade) {
  float x = max(z, F(0.0)), over = x - F(0.5) * fade;
  return x < fade ? x * x * x * invFade * F(0.166666667) : F(0.5) * over * over + fade * fade * F(0.0416666667);
}
WK_FN float profileArea(LayerAt a, float z) {
  float T = a.thickness_m, f = a.baseFade_m, g = a.topFade_m;
  float area = T - F(0.5) * (f + g), end = rampArea(T, f, a.invBaseFade) - g * g * F(0.166666667);
  return z < T ? rampArea(z, f, a.invBaseFade) - rampArea(z - T + g, g, a.invTopFade) : end + area * (z - T);
}
// Mean of profileMean over windows of half height `reach` whose middles are up to `blur` from z.
WK_FN float profileBlurred(LayerAt a, float z, float reach, float blur) {
  if (z + reach + blur <= F(0.0) || z - reach - blur >= a.thickness_m) return F(0.0);
  float up = profileArea(a, z + reach + blur) - profileArea(a, z + reach - blur);
  float down = profileArea(a, z - reach + blur) - profileArea(a, z - reach - blur);
  return max(up - down, F(0.0)) / (F(4.0) * reach * blur);
}

WK_FN float profileAt(LayerAt a, float z) {
  return min(clamp(z * a.invBaseFade, F(0.0), F(1.0)), clamp((a.thickness_m - z) * a.invTopFade, F(0.0), F(1.0)));
}

// E[max(x + u, 0)] for u with the triangle density on [-a, a]; inv6a2 = 1 / (6 a^2), or 0 for a = 0.
WK_FN float expectedPositive(float x, float a, float inv6a2) {
  float m = max(a - abs(x), F(0.0));
  return max(x, F(0.0)) + m * m * m * inv6a2;
}

WK_FN float typeWeight(WK_SOURCE_PARAM uint layer, float type) {
  if (WK_LAYER(layer).typed == 0u) return F(1.0);
  float rise = clamp((type - WK_LAYER(layer).typeLow) * WK_LAYER(layer).typeInvRiseLow, F(0.0), F(1.0));
  float fall = clamp((WK_LAYER(layer).typeHigh - type) * WK_LAYER(layer).typeInvRiseHigh, F(0.0), F(1.0));
  return min(rise, fall);
}

WK_FN float layerCover(WK_SOURCE_PARAM uint layer, float cover, float type) {
  return clamp(cover * WK_LAYER(layer).coverGain + WK_LAYER(layer).coverBias, F(0.0), F(1.0)) * typeWeight(WK_SOURCE_ARG layer, type);
}

WK_FN float thresholdOf(WK_SOURCE_PARAM uint layer, float cover) {
  float s = cover * float(kThresholdSteps);
  int i = min(int(s), int(kThresholdSteps) - 1);
  float low = WK_LAYER(layer).threshold[i];
  return low + (s - float(i)) * (WK_LAYER(layer).threshold[i + 1] - low);
}

// The last thirty-second of cover also thins the cloud: where there is no cover there is exactly nothing, without a step.
WK_FN float thinness(float cover) { return min(cover * F(32.0), F(1.0)); }

// How much the layer's height is stretched: its top falls to the base where cover is thin.
WK_FN float heightScale(float topFollowsCover, float cover) { return F(1.0) / (F(1.0) - topFollowsCover * (F(1.0) - cover)); }

WK_FN uint warpSteps(float n, float steps) { return uint(int(floor(n * steps))); }

// The position at which noise is taken: shifted by slow noise, so that streaks bend.
WK_FN uvec3 warpedPosition(WK_SOURCE_PARAM uint layer, uvec3 p) {
  uint shift = WK_LAYER(layer).warpShift, seed = WK_LAYER(layer).seed;
  float steps = WK_LAYER(layer).warp_steps;
  float a = noise3(p, shift, shift, octaveSeed(seed, 101u)), b = noise3(p, shift, shift, octaveSeed(seed, 102u));
  return uvec3(p.x + warpSteps(b, steps), p.y - warpSteps(b, steps), p.z + warpSteps(a, steps));
}

// Clouds smaller than a voxel hide less than their mean does. Columns of which a fraction c holds cloud of optical depth t have the
// effective optical depth -log(1 - c + c exp(-t)), less than their mean c t by about 1 / (1 + (1 - c) t). `clump` is t, as measured for the
// layer, times the share of the noise that the level does not show: it vanishes as the clouds get resolved, and full cover is
// untouched. So transmittance survives on every level, not only its logarithm; from space a field of small heaps is grey, not white.
WK_FN float clumping(float clump, float c) { return clump > F(0.0) ? F(1.0) / (F(1.0) + clump * (F(1.0) - c)) : F(1.0); }

// A layer at a height, before its noise is known.
struct LayerPlace {
  float profile;   // 0: no cloud whatever the noise
  float threshold; // that the noise must exceed
};
// `h` is the magnitude of the altitude in metres: cloud is mirrored at the ground, so samples below it carry what the average of the
// samples above would lose. `c` is the layer's own cover.
WK_FN LayerPlace layerPlace(LayerAt a, float h, float c, float coverThreshold) {
  float scale = heightScale(a.topFollowsCover, c);
  float z = (h - a.base_m) * scale, reach = F(0.5) * a.filter_m * scale, blur = F(0.5) * a.blur_m * scale;
  float profile = profileAt(a, z), middle = z;
  if (a.filter_m > F(0.0)) {
    float mirrored = F(-2.0) * a.base_m * scale - z;
    if (a.blur_m > F(0.0)) {
      profile = profileBlurred(a, z, reach, blur) + profileBlurred(a, mirrored, reach, blur);
      reach += blur;
    } else {
      profile = profileMean(a, z - reach, z + reach) + profileMean(a, mirrored - reach, mirrored + reach);
    }
    middle = F(0.5) * (clamp(z - reach, F(0.0), a.thickness_m) + clamp(z + reach, F(0.0), a.thickness_m));
  }
  profile = c > F(0.0) ? min(profile, F(1.0)) : F(0.0);
  return WK_NEW(LayerPlace, profile, coverThreshold + a.taper * clamp(middle * a.invThickness, F(0.0), F(1.0)));
}

// Extinction in 1/m there, for the sum `n` of the octaves that the level shows.
WK_FN float layerValue(LayerAt a, LayerPlace place, float c, float n) {
  float x = (n - place.threshold) * a.invSoftness;
  float ramp = F(1.0);
  if (x - F(1.0) < a.spread)
    ramp = clamp(expectedPositive(x, a.spread, a.invSpread2) - expectedPositive(x - F(1.0), a.spread, a.invSpread2), F(0.0), F(1.0));
  return a.extinction_per_m * place.profile * ramp * thinness(c) * clumping(a.clump, c);
}

// Extinction in 1/m of one layer. `altitude_m` is that of p; cover and type are 0..1.
WK_FN float layerDensity(WK_SOURCE_PARAM uint layer, uvec3 p, uint level, float altitude_m, float cover, float type) {
  LayerAt a = layerAt(WK_SOURCE_ARG layer, level);
  float h = abs(altitude_m), reach = F(0.5) * (a.filter_m + a.blur_m);
  if (h + reach <= a.base_m || h - reach >= a.base_m + a.thickness_m) return F(0.0);
  float c = layerCover(WK_SOURCE_ARG layer, cover, type);
  if (c <= F(0.0)) return F(0.0);
  LayerPlace place = layerPlace(a, h, c, thresholdOf(WK_SOURCE_ARG layer, c));
  if (place.profile <= F(0.0)) return F(0.0);
  uint octaves = WK_LAYER(layer).octaves[level], shift = WK_LAYER(layer).shift, streak = WK_LAYER(layer).streak;
  float billow = WK_LAYER(layer).billow, gain = WK_LAYER(layer).gain, amplitude = WK_LAYER(layer).amplitude;
  float restHigh = WK_LAYER(layer).restHigh;
  float n = F(0.0), rest = WK_LAYER(layer).shown[level];
  uvec3 q = p;
  if (octaves > 0u && WK_LAYER(layer).warp_steps > F(0.0)) q = warpedPosition(WK_SOURCE_ARG layer, p);
  for (uint k = 0u; k < octaves; ++k) {
    n += amplitude * billowNoise(noise3(q, shift - k, shift - k - streak, octaveSeed(WK_LAYER(layer).seed, k)), billow);
    rest -= amplitude;
    amplitude *= gain;
    float x0 = (n - place.threshold) * a.invSoftness, room = rest * restHigh * a.invSoftness + a.spread;
    // no later octave can bring it back, up or down
    if (x0 + room <= F(0.0)) return F(0.0);
    if (x0 - room >= F(1.0)) break;
  }
  return layerValue(a, place, c, n);
}

// Cover and type at p: trilinear in its node's lattice.
WK_FN Weather weatherBetween(WK_SOURCE_PARAM uvec3 p, uint level) {
  uvec3 corner = nodeCorner(p, level);
  vec3 at = nodeLocal(p, level) * F(3.0);
  uvec3 i = uvec3(min(uint(at.x), 2u), min(uint(at.y), 2u), min(uint(at.z), 2u));
  vec3 f = at - vec3(float(i.x), float(i.y), float(i.z));
  float cover = F(0.0), type = F(0.0);
  for (uint k = 0u; k < 8u; ++k) {
    uvec3 o = uvec3(k & 1u, (k >> 1u) & 1u, k >> 2u);
    float w = (o.x == 1u ? f.x : F(1.0) - f.x) * (o.y == 1u ? f.y : F(1.0) - f.y) * (o.z == 1u ? f.z : F(1.0) - f.z);
    if (w <= F(0.0)) continue;
    Weather one = weatherAt(WK_SOURCE_ARG weatherPoint(corner, level, i + o), level);
    cover += w * one.cover;
    type += w * one.type;
  }
  return WK_NEW(Weather, cover, type);
}

// Extinction in 1/m of all layers: the densest one counts, so a tower that pierces a deck is no denser for it.
WK_FN float layersDensity(WK_SOURCE_PARAM uvec3 p, uint level) {
  float altitude_m = cloudAltitude(WK_SOURCE_ARG p);
  float h = abs(altitude_m), reach = F(1.5) * WK_HEADER.footprint_m[level];
  if (h + reach <= WK_HEADER.lowest_m || h - reach >= WK_HEADER.highest_m) return F(0.0);
  Weather weather = weatherBetween(WK_SOURCE_ARG p, level);
  if (weather.cover <= F(0.0)) return F(0.0);
  float density = F(0.0);
  for (uint layer = 0u; layer < WK_HEADER.layerCount; ++layer)
    density = max(density, layerDensity(WK_SOURCE_ARG layer, p, level, altitude_m, weather.cover, weather.type));
  return density;
}

WK_END
