// The view tables: for one camera altitude and sun zenith angle, in-scatter and optical depth from the camera along every ray, per
// kRateLength_m of path, so that both are linear near the camera and fit 16-bit floats.
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
