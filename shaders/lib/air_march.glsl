// Builds the air's tables. Everything is per unit of the sun's irradiance. AIR_LAYERS, AIR_PROFILE_i and AIR_PHASE_i come from the
// scene, so that the loop over layers unrolls into straight code.
#include "lib/air.glsl"

struct AirPoint {
  vec3 extinction;      // 1/m
  vec3 scattering;      // all layers
  vec3 scatterPhase;    // scattering times phase function of the layers that tables hold with their phase
  vec3 peak;            // scattering of the layer whose phase function is applied at look-up
};

const uint kProfiles[6] = uint[6](AIR_PROFILE_0, AIR_PROFILE_1, AIR_PROFILE_2, AIR_PROFILE_3, AIR_PROFILE_4, AIR_PROFILE_5);
const uint kPhases[6] = uint[6](AIR_PHASE_0, AIR_PHASE_1, AIR_PHASE_2, AIR_PHASE_3, AIR_PHASE_4, AIR_PHASE_5);

// phases[i]: value of layer i's phase function for this ray and the sun.
AirPoint airPoint(AirBlock air, float altitude_m, float phases[AIR_LAYERS]) {
  AirPoint p = AirPoint(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
  for (uint i = 0u; i < uint(AIR_LAYERS); ++i) {
    AirLayer layer = air.layers[i];
    layer.profile = kProfiles[i];
    float density = layerDensity(layer, altitude_m);
    vec3 scattering = layerScattering(layer) * density;
    p.extinction += layerExtinction(layer) * density;
    p.scattering += scattering;
    if (i == uint(AIR_PEAK_LAYER)) p.peak = scattering;
    else p.scatterPhase += scattering * phases[i];
  }
  return p;
}

float[AIR_LAYERS] airPhases(AirBlock air, float cosine) {
  float phases[AIR_LAYERS];
  for (uint i = 0u; i < uint(AIR_LAYERS); ++i) phases[i] = phaseValue(kPhases[i], air.layers[i].g, cosine);
  return phases;
}

float airPeakPhase(AirParams air, float cosine) {
  return air.peakLayer == kNoLayer ? 0.0 : phaseValue(air.peakPhase, air.peakG, cosine);
}

// Altitude and the sun's zenith cosine at distance t along a ray.
struct AirStep {
  float altitude_m, muSun;
};
AirStep airStep(AirParams air, float h0, float mu, float muSun0, float cosine, float t) {
  float h = max(altitudeAlong(h0, mu, t, air.radius_m), 0.0);
  return AirStep(h, ((air.radius_m + h0) * muSun0 + t * cosine) / (air.radius_m + h));
}

vec3 airMultiple(sampler2D multiple, AirParams air, float altitude_m, float muSun) {
  vec2 uv = airTexel(vec2(sunCoord(muSun), altitudeCoord(air, altitude_m)), vec2(textureSize(multiple, 0)));
  return textureLod(multiple, uv, 0.0).rgb;
}

// integral of exp(-extinction s) ds over the step: exact for a constant medium, also where nothing is.
vec3 airStepWeight(vec3 extinction, float dt) {
  vec3 tau = extinction * dt;
  // Below tau = 0.01 the series is exact to tau^3/24 = 4e-8; above, 1 - exp loses at most two digits.
  vec3 series = 1.0 - tau * (0.5 - tau * (1.0 / 6.0));
  vec3 exact = (1.0 - exp(-tau)) / max(tau, vec3(0.01));
  return dt * mix(exact, series, lessThan(tau, vec3(0.01)));
}

// The ray's segment in the air: length in m, slice spacing, and whether the ground ends it.
struct AirSegment {
  float length_m, slices;
  bool ground;
};
float skySlices(AirParams air, float h0) { return clamp(h0 / air.top_m, 0.0, 1.0) - 1.0; }
float groundSlices(float h0) { return h0 / (h0 + 10000.0); }
AirSegment airSegment(AirParams air, float h0, float mu) {
  if (mu < horizonCosine(air.radius_m, h0)) return AirSegment(distanceToGround(air, h0, mu), groundSlices(h0), true);
  return AirSegment(distanceToTop(air, h0, mu), skySlices(air, h0), false);
}

// Radiance of the air along a ray by single scattering plus the multiple-scattering table, and the ground's behind it.
struct AirRadiance {
  vec3 light, transmittance;
};
AirRadiance airMarch(sampler2D depthToTop, sampler2D multiple, AirBlock air, float h0, float mu, float muSun0, float cosine,
                     AirSegment segment, int steps) {
  AirRadiance sum = AirRadiance(vec3(0.0), vec3(1.0));
  float phases[AIR_LAYERS] = airPhases(air, cosine);
  float peak = airPeakPhase(air.params, cosine);
  float t0 = 0.0;
  for (int i = 0; i < steps; ++i) {
    float t1 = segment.length_m * airSliceAt(segment.slices, float(i + 1) / float(steps));
    float dt = t1 - t0;
    AirStep at = airStep(air.params, h0, mu, muSun0, cosine, t0 + 0.5 * dt);
    AirPoint p = airPoint(air, at.altitude_m, phases);
    vec3 source = (p.scatterPhase + p.peak * peak) * airSunTransmittance(depthToTop, air.params, at.altitude_m, at.muSun);
    source += p.scattering * airMultiple(multiple, air.params, at.altitude_m, at.muSun);
    sum.light += sum.transmittance * source * airStepWeight(p.extinction, dt);
    sum.transmittance *= exp(-p.extinction * dt);
    t0 = t1;
  }
  return sum;
}
