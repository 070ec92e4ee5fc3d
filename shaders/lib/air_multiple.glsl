// Multiple scattering, all orders above the first, as an isotropic source (Hillaire 2020): the second order and the fraction f
// of light that one more scattering event hands on are integrated over directions; the geometric series 1 / (1 - f) adds the rest.
#include "lib/air_march.glsl"

struct AirOrders {
  vec3 second, fraction;
};

AirOrders airOrdersAlong(sampler2D depthToTop, AirBlock air, float h0, float mu, float muSun0, float cosine, int steps) {
  AirOrders sum = AirOrders(vec3(0.0), vec3(0.0));
  AirSegment segment = airSegment(air.params, h0, mu);
  vec3 transmittance = vec3(1.0);
  float phases[AIR_LAYERS] = airPhases(air, cosine);
  float t0 = 0.0;
  for (int i = 0; i < steps; ++i) {
    float t1 = segment.length_m * airSliceAt(segment.slices, float(i + 1) / float(steps));
    float dt = t1 - t0;
    AirStep at = airStep(air.params, h0, mu, muSun0, cosine, t0 + 0.5 * dt);
    AirPoint p = airPoint(air, at.altitude_m, phases);
    vec3 reach = transmittance * p.scattering * airStepWeight(p.extinction, dt);
    sum.second += reach * kInv4Pi * airSunTransmittance(depthToTop, air.params, at.altitude_m, at.muSun);
    sum.fraction += reach;
    transmittance *= exp(-p.extinction * dt);
    t0 = t1;
  }
  if (segment.ground) {
    AirStep at = airStep(air.params, h0, mu, muSun0, cosine, segment.length_m);
    vec3 sun = airSunTransmittance(depthToTop, air.params, 0.0, at.muSun) * max(at.muSun, 0.0);
    sum.second += transmittance * groundAlbedo(air.params) * sun * (1.0 / kPi);
  }
  return sum;
}

vec3 airMultipleAt(sampler2D depthToTop, AirBlock air, float h0, float muSun) {
  const int kZeniths = 16, kAzimuths = 8;
  float sinSun = sqrt(max(1.0 - muSun * muSun, 0.0));
  AirOrders mean = AirOrders(vec3(0.0), vec3(0.0));
  for (int k = 0; k < kZeniths * kAzimuths; ++k) {
    float mu = 2.0 * (float(k / kAzimuths) + 0.5) / float(kZeniths) - 1.0;
    float azimuth = kPi * (float(k % kAzimuths) + 0.5) / float(kAzimuths);  // the other half is its mirror image
    float cosine = mu * muSun + sqrt(1.0 - mu * mu) * sinSun * cos(azimuth);
    AirOrders o = airOrdersAlong(depthToTop, air, h0, mu, muSun, cosine, 20);
    mean.second += o.second;
    mean.fraction += o.fraction;
  }
  float weight = 1.0 / float(kZeniths * kAzimuths);
  return mean.second * weight / (1.0 - mean.fraction * weight);
}
