// Directions in which a point of the field's table looks, and their weights.
#include "lib/air_path.glsl"

// First in the list come directions about the vertical (x: -1..1 of the angle from the horizon, below it negative; y: cosine of the azimuth
// from the sun; z: weight), then directions about the sun for each peaked layer (x: cosine from the sun; y: cosine of the azimuth about it;
// z: weight with the layer's phase function in it; w: the layer).
struct GatherDirection {
  float mu, cosine, weight;
  int layer;  // whose single scattering it carries; -1: that of all layers that are not peaked
};
GatherDirection gatherDirection(AirParams air, vec4 d, bool aboutSun, float altitude_m, float muSun) {
  float sinSun = sqrt(max(1.0 - muSun * muSun, 0.0));
  if (aboutSun) {
    float mu = d.x * muSun + sqrt(max(1.0 - d.x * d.x, 0.0)) * d.y * sinSun;
    return GatherDirection(clamp(mu, -1.0, 1.0), d.x, d.z, int(d.w));
  }
  float dip = acos(air.radius_m / (air.radius_m + altitude_m));
  // angle from the horizon = extent x^2: dense at the horizon
  float extent = 0.5 * kPi + (d.x > 0.0 ? dip : -dip);
  float elevation = extent * d.x * abs(d.x) - dip;
  float mu = sin(elevation), across = cos(elevation);
  return GatherDirection(mu, mu * muSun + across * sinSun * d.y, d.z * across * 2.0 * extent * abs(d.x), -1);
}
