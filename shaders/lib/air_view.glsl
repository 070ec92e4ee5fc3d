// The view tables: for one camera altitude and sun zenith angle, in-scatter and optical depth from the camera along every ray, per
// kRateLength_m of path, so that both are linear near the camera and fit 16-bit floats.
#include "lib/air_march.glsl"

// A ray of the tables, at its anchor: zenith cosine, the sun's zenith cosine there, cosine between ray and sun.
struct AirViewRay {
  float mu, muSun, cosine;
};

AirViewRay airViewRay(AirViewFrame view, float mu, float cosAzimuth) {
  // Zenith angle at the camera: sin = sin(at the anchor) * anchor radius / camera radius, on the anchor's side of the vertical.
  float sinAnchor = sqrt(max(1.0 - mu * mu, 0.0));
  float sinCamera = sinAnchor * view.anchorOverCentre;
  float cosCamera = view.anchorOverCentre < 1.0 ? -sqrt(1.0 - sinCamera * sinCamera) : mu;
  // The anchor's vertical is turned from the camera's by the difference of both zenith angles, in the ray's plane.
  float cosTurn = cosCamera * mu + sinCamera * sinAnchor;
  float sinTurn = sinCamera * mu - cosCamera * sinAnchor;
  AirViewRay ray;
  ray.mu = mu;
  ray.muSun = cosTurn * view.cosSun + sinTurn * cosAzimuth * view.sinSun;
  ray.cosine = cosCamera * view.cosSun + sinCamera * cosAzimuth * view.sinSun;
  return ray;
}

// What one step between t0 and t1 adds.
struct AirViewSum {
  vec3 depth, smoothPart, peakPart;
};

AirViewSum airViewStep(sampler2D depthToTop, sampler2D multiple, AirBlock air, AirViewRay ray, float phases[AIR_LAYERS], AirViewSum sum,
                       float t0, float t1) {
  float dt = t1 - t0;
  AirStep at = airStep(air.params, air.view.anchorAltitude_m, ray.mu, ray.muSun, ray.cosine, t0 + 0.5 * dt);
  AirPoint p = airPoint(air, at.altitude_m, phases);
  vec3 sun = airSunTransmittance(depthToTop, air.params, at.altitude_m, at.muSun);
  vec3 reach = exp(-sum.depth) * airStepWeight(p.extinction, dt);
  sum.smoothPart += reach * (p.scatterPhase * sun + p.scattering * airMultiple(multiple, air.params, at.altitude_m, at.muSun));
  sum.peakPart += reach * p.peak * sun;
  sum.depth += p.extinction * dt;
  return sum;
}

// The limit of sum / path at the camera: the local source and extinction.
AirViewSum airViewStart(sampler2D depthToTop, sampler2D multiple, AirBlock air, AirViewRay ray, float phases[AIR_LAYERS]) {
  float h = air.view.anchorAltitude_m;
  AirPoint p = airPoint(air, h, phases);
  vec3 sun = airSunTransmittance(depthToTop, air.params, h, ray.muSun);
  return AirViewSum(p.extinction, p.scatterPhase * sun + p.scattering * airMultiple(multiple, air.params, h, ray.muSun), p.peak * sun);
}
