// The view tables: for one camera altitude and sun zenith angle, from the camera along every ray: optical depth per kRateLength_m of path,
// and in-scatter over the opacity of the air up to there, which is the mean ratio of source and extinction. Both change little along a ray,
// thin or thick; per unit of the sun's irradiance and times kSourceScale the second fits 16-bit floats from noon to the end of twilight.
#include "lib/air_path.glsl"

AirPath airViewPath(AirViewFrame view, float mu, float cosAzimuth) {
  // Zenith angle at the camera: sin = sin(at the anchor) * anchor radius / camera radius, on the anchor's side of the vertical.
  float sinAnchor = sqrt(max(1.0 - mu * mu, 0.0));
  float sinCamera = sinAnchor * view.anchorOverCentre;
  float cosCamera = view.anchorOverCentre < 1.0 ? -sqrt(1.0 - sinCamera * sinCamera) : mu;
  // The anchor's vertical is turned from the camera's by the difference of both zenith angles, in the ray's plane.
  float cosTurn = cosCamera * mu + sinCamera * sinAnchor;
  float sinTurn = sinCamera * mu - cosCamera * sinAnchor;
  AirPath path;
  path.altitude_m = view.anchorAltitude_m;
  path.mu = mu;
  path.muSun = clamp(cosTurn * view.cosSun + sinTurn * cosAzimuth * view.sinSun, -1.0, 1.0);
  path.cosine = clamp(cosCamera * view.cosSun + sinCamera * cosAzimuth * view.sinSun, -1.0, 1.0);
  return path;
}

vec3 airMeanSource(vec3 light, vec3 depth) { return kSourceScale * light / max(airOpacity(depth), vec3(1e-30)); }  // nothing over nothing: 0
