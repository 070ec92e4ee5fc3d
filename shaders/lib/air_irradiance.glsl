// Irradiance of horizontal planes by the air and the ground, without the sun itself.
#include "lib/air_march.glsl"

// facing: 1 up, -1 down. `groundSky`: table that holds the upward-facing irradiance at the ground (read when facing down only).
vec3 airIrradianceAt(sampler2D depthToTop, sampler2D multiple, sampler2D groundSky, AirBlock air, float h0, float muSun, float facing) {
  const int kZeniths = 16, kAzimuths = 8;
  float sinSun = sqrt(max(1.0 - muSun * muSun, 0.0));
  vec3 sum = vec3(0.0);
  for (int k = 0; k < kZeniths * kAzimuths; ++k) {
    // even in cos^2, which carries the cosine's weight; denser in azimuth towards the sun, where the forward peak is
    float mu = facing * sqrt((float(k / kAzimuths) + 0.5) / float(kZeniths));
    float x = (float(k % kAzimuths) + 0.5) / float(kAzimuths);
    float cosine = mu * muSun + sqrt(1.0 - mu * mu) * sinSun * cos(kPi * x * x);
    AirSegment segment = airSegment(air.params, h0, mu);
    AirRadiance seen = airMarch(depthToTop, multiple, air, h0, mu, muSun, cosine, segment, 24);
    if (segment.ground) {
      float muGround = airStep(air.params, h0, mu, muSun, cosine, segment.length_m).muSun;
      vec3 lit = airSunTransmittance(depthToTop, air.params, 0.0, muGround) * max(muGround, 0.0);
      vec2 size = vec2(textureSize(groundSky, 0));
      lit += textureLod(groundSky, vec2(texelCoord(sunCoord(muGround), size.x), 0.5 / size.y), 0.0).rgb;
      seen.light += seen.transmittance * groundAlbedo(air.params) * lit * (1.0 / kPi);
    }
    sum += seen.light * (2.0 * x);
  }
  return sum * (kPi / float(kZeniths * kAzimuths));
}
