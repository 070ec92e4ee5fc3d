// Radiance along a path through the air, per unit of the sun's irradiance. AIR_LAYERS, AIR_PROFILE_i, AIR_PHASE_i and AIR_DEGREE_i come from the
// scene, so that the loops over layers unroll into straight code.
#include "lib/air_field.glsl"

const uint kProfiles[6] = uint[6](AIR_PROFILE_0, AIR_PROFILE_1, AIR_PROFILE_2, AIR_PROFILE_3, AIR_PROFILE_4, AIR_PROFILE_5);
const uint kPhases[6] = uint[6](AIR_PHASE_0, AIR_PHASE_1, AIR_PHASE_2, AIR_PHASE_3, AIR_PHASE_4, AIR_PHASE_5);
const int kDegrees[6] = int[6](AIR_DEGREE_0, AIR_DEGREE_1, AIR_DEGREE_2, AIR_DEGREE_3, AIR_DEGREE_4, AIR_DEGREE_5);  // last moment; -1: scatters nothing

// A straight path from an anchor: altitude, zenith cosine, the sun's zenith cosine, cosine between path and sun.
struct AirPath {
  float altitude_m, mu, muSun, cosine;
};

// Where a path is at distance t.
struct AirPlace {
  float altitude_m, mu, muSun;
};
AirPlace airPlace(AirParams air, AirPath path, float t) {
  float h = max(altitudeAlong(path.altitude_m, path.mu, t, air.radius_m), 0.0);
  float r0 = air.radius_m + path.altitude_m, r = air.radius_m + h;
  return AirPlace(h, (r0 * path.mu + t) / r, clamp((r0 * path.muSun + t * path.cosine) / r, -1.0, 1.0));
}

// The medium at one place: 1/m.
struct AirPoint {
  vec3 extinction, reduced;               // physical; without what counts as scattered straight on
  vec3 single;                            // scattering times the factor of each layer
  vec3 diffuse[FIELD_ZONAL + 1];          // scattering times Legendre moment, less what counts as straight on
  vec3 peak;                              // scattering of AIR_PEAK_LAYER
};
AirPoint airPoint(AirBlock air, float altitude_m, float factors[AIR_LAYERS]) {
  AirPoint p;
  p.extinction = p.reduced = p.single = p.peak = vec3(0.0);
  for (int l = 0; l <= FIELD_ZONAL; ++l) p.diffuse[l] = vec3(0.0);
  for (int i = 0; i < AIR_LAYERS; ++i) {
    AirLayer layer = air.layers[i];
    layer.profile = kProfiles[i];
    float density = layerDensity(layer, altitude_m);
    p.extinction += layerExtinction(layer) * density;
    p.reduced += layerReducedExtinction(layer) * density;
    vec3 scattering = layerScattering(layer) * density;
    if (kDegrees[i] >= 0) p.single += scattering * factors[i];
    if (i == AIR_PEAK_LAYER) p.peak = scattering;
    for (int l = 0; l <= min(kDegrees[i], READ_ZONAL); ++l) p.diffuse[l] += scattering * (layer.moments[l >> 2][l & 3] - layer.forward);
  }
  return p;
}

// Value of each layer's phase function for single scattering; `peakToo`: of AIR_PEAK_LAYER as well (else 0: applied at look-up).
float[AIR_LAYERS] airPhases(AirBlock air, float cosine, bool peakToo) {
  float phases[AIR_LAYERS];
  for (int i = 0; i < AIR_LAYERS; ++i)
    phases[i] = i == AIR_PEAK_LAYER && !peakToo ? 0.0 : phaseValue(kPhases[i], air.layers[i].g, cosine);
  return phases;
}

// What a path has gathered.
struct AirSum {
  vec3 light;    // radiance at the start of the path
  vec3 peak;     // the same by AIR_PEAK_LAYER, without its phase function
  vec3 depth;    // optical depth
  vec3 reduced;  // of it without what counts as scattered straight on: dims `light`
};
AirSum airNothing() { return AirSum(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0)); }

// What is the same at every place of a path.
struct AirTerms {
  float factors[AIR_LAYERS];
  float harmonics[kFieldCount];
};

struct AirNode {
  vec3 extinction, reduced, light, peak;
};
// SINGLE, DIFFUSE: 1 if light straight from the sun, or from the field, is scattered.
AirNode airNode(sampler2D sunDepth, sampler2DArray field, AirBlock air, AirPath path, AirTerms terms, float t) {
  AirPlace place = airPlace(air.params, path, t);
  AirPoint p = airPoint(air, place.altitude_m, terms.factors);
  AirNode node = AirNode(p.extinction, p.reduced, vec3(0.0), vec3(0.0));
#if SINGLE
  vec3 sun = airSunTransmittance(sunDepth, air.params, place.altitude_m, place.muSun);
  node.light = p.single * sun;
  node.peak = p.peak * sun;
#endif
#if DIFFUSE
  vec2 uv = fieldTexel(air.params, vec2(textureSize(field, 0).xy), place.altitude_m, place.muSun);
  node.light += fieldSource(field, uv, p.diffuse, terms.harmonics, azimuthal(place.mu, place.muSun, path.cosine));
#endif
  return node;
}

AirTerms airTerms(AirPath path, float factors[AIR_LAYERS]) {
  return AirTerms(factors, harmonics(path.cosine));
}

// The piece from t0 to t1: two Gauss nodes, optical depth at them by collocation (order 4). The light is scaled to what a constant
// ratio of source and extinction gives exactly, for any thickness; below a depth of 0.01 that ratio is 1 to 1e-9.
AirSum airPiece(AirSum sum, AirNode a, AirNode b, float dt) {
  vec3 depth = 0.5 * dt * (a.reduced + b.reduced);
  vec3 depthA = max(dt * (0.25 * a.reduced - 0.038675135 * b.reduced), vec3(0.0));
  vec3 depthB = dt * (0.538675135 * a.reduced + 0.25 * b.reduced);
  vec3 dimA = exp(-depthA);
  vec3 later = max(exp(min(depthA - depthB, vec3(0.0))), vec3(1e-25));  // of b against a; not 0, so that 0 / 0 cannot arise below
  vec3 thin = 0.5 * dt * dimA;
  vec3 thick = (1.0 - exp(-depth)) / max(a.reduced + b.reduced * later, vec3(1e-37));
  vec3 weight = exp(-sum.reduced) * mix(thick, thin, lessThan(depth, vec3(0.01)));
  sum.light += weight * (a.light + b.light * later);
  sum.peak += weight * (a.peak + b.peak * later);
  sum.depth += 0.5 * dt * (a.extinction + b.extinction);
  sum.reduced += depth;
  return sum;
}

AirSum airStretch(sampler2D sunDepth, sampler2DArray field, AirBlock air, AirPath path, AirTerms terms, AirSum sum, float t0, float t1) {
  float dt = t1 - t0;
  AirNode a = airNode(sunDepth, field, air, path, terms, t0 + 0.211324865 * dt);
  AirNode b = airNode(sunDepth, field, air, path, terms, t0 + 0.788675135 * dt);
  return airPiece(sum, a, b, dt);
}

// A path's extent in the air.
struct AirExtent {
  float length_m, lowest_m;  // lowest_m: distance to its lowest point
  bool ground;               // ends there
};
AirExtent airExtent(AirParams air, float altitude_m, float mu) {
  if (mu < horizonCosine(air.radius_m, altitude_m)) {
    float t = distanceToGround(air, altitude_m, mu);
    return AirExtent(t, t, true);
  }
  float end = distanceToTop(air, altitude_m, mu);
  return AirExtent(end, clamp(-mu * (air.radius_m + altitude_m), 0.0, end), false);
}

// Distance at the fraction x of a path's pieces: the part down to the lowest point is dense at both ends, the part up dense at its start.
float airPieceAt(AirExtent e, float x) {
  float split = e.lowest_m <= 0.0 ? 0.0 : e.lowest_m >= e.length_m ? 1.0 : 0.5;
  float down = split > 0.0 ? min(x / split, 1.0) : 1.0;
  float up = split < 1.0 ? max(x - split, 0.0) / (1.0 - split) : 0.0;
  return e.lowest_m * down * down * (3.0 - 2.0 * down) + (e.length_m - e.lowest_m) * up * up;
}

AirSum airAlongPath(sampler2D sunDepth, sampler2DArray field, AirBlock air, AirPath path, AirTerms terms, AirExtent extent, int pieces) {
  AirSum sum = airNothing();
  float t0 = 0.0;
  for (int i = 1; i <= pieces; ++i) {
    float t1 = airPieceAt(extent, float(i) / float(pieces));
    sum = airStretch(sunDepth, field, air, path, terms, sum, t0, t1);
    t0 = t1;
  }
  return sum;
}

// Radiance of the ground at the end of a path that meets it: light of the sun (SINGLE) and of the sky (DIFFUSE), Lambert's law.
vec3 airGround(sampler2D sunDepth, sampler2D irradiance, AirBlock air, AirPath path, float length_m) {
  float muSun = airPlace(air.params, path, length_m).muSun;
  vec3 lit = vec3(0.0);
#if SINGLE
  lit += airSunTransmittance(sunDepth, air.params, 0.0, muSun) * max(muSun, 0.0);
#endif
#if DIFFUSE
  vec2 size = vec2(textureSize(irradiance, 0)) * vec2(1.0, 0.5);
  lit += exp(textureLod(irradiance, airTexel(vec2(sunCoord(air.params, muSun), 0.0), size) * vec2(1.0, 0.5), 0.0).rgb);
#endif
  return groundAlbedo(air.params) * lit * (1.0 / kPi);
}
