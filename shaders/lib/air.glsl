// Look-ups of the air's tables. Units: metres; irradiance and radiance in those of the scene's sun.
#include "welkin/shared/air.glsl.h"

struct AirLight {
  vec3 fromAbove;  // irradiance of a horizontal plane facing up, without the sun's direct light
  vec3 fromBelow;  // of one facing down: ground and air below
};

struct AirView {
  vec3 inscatter;      // radiance that the air adds between the camera and the point
  vec3 transmittance;  // of the air between them
};

vec2 airTexel(vec2 coord, vec2 size) { return (0.5 + coord * (size - 1.0)) / size; }

// Towards the sun; 0 in the planet's shadow, soft by the sun's angular size. Altitudes above the shell count as its top. The table has
// the logarithm of the optical depth, the mean over the visible part of the disc, placed by the disc's upper edge.
vec3 airSunTransmittance(sampler2D sunDepth, AirParams air, float altitude_m, float muSun) {
  float h = clamp(altitude_m, 0.0, air.top_m);
  float mu = max(sunEdgeCosine(air, muSun), horizonCosine(air.radius_m, h));
  vec2 uv = airTexel(transmittanceCoord(air, h, mu), vec2(textureSize(sunDepth, 0)));
  return exp(-exp(textureLod(sunDepth, uv, 0.0).rgb)) * sunVisible(air, h, muSun);
}

// The table has logarithms, planes facing up first, then below them those facing down.
AirLight airSkyIrradiance(sampler2D irradiance, AirParams air, float altitude_m, float muSun) {
  vec2 size = vec2(textureSize(irradiance, 0)) * vec2(1.0, 0.5);  // two tables, one above the other
  vec2 uv = airTexel(vec2(sunCoord(air, muSun), altitudeCoord(air, altitude_m)), size) * vec2(1.0, 0.5);
  AirLight light;
  light.fromAbove = exp(textureLod(irradiance, uv, 0.0).rgb) * sunIrradiance(air);
  light.fromBelow = exp(textureLod(irradiance, uv + vec2(0.0, 0.5), 0.0).rgb) * sunIrradiance(air);
  return light;
}

// A pixel's place in the view tables: computed once, good for every distance along its ray.
struct AirRay {
  float u;          // of the view tables, half of the sky or of the ground
  float azimuth;
  float slices;
  float length_m;   // of the ray's segment in the air; 0: none
  float anchor_m;
  float peakPhase;
  vec3 light;       // irradiance of the sun over the tables' scale
};

AirRay airRay(sampler3D scatter, AirParams air, AirViewFrame view, Ray ray) {
  AirRay a;
  bool ground = ray.ground_m >= 0.0;
  a.anchor_m = max(ray.anchor_m, 0.0);
  a.length_m = ray.anchor_m < 0.0 ? 0.0 : max((ground ? ray.ground_m : ray.exit_m) - a.anchor_m, 0.0);
  a.slices = ground ? view.groundSlices : view.skySlices;
  vec3 up = vec3(view.upX, view.upY, view.upZ);
  vec3 sun = vec3(view.sunX, view.sunY, view.sunZ);
  vec3 horizontal = ray.dir - up * dot(ray.dir, up);
  // The smallest normal float only keeps straight up and down, where any azimuth is right, from 0 / 0.
  vec3 axis = vec3(view.axisX, view.axisY, view.axisZ);
  float cosAzimuth = dot(horizontal, axis) * inversesqrt(max(dot(horizontal, horizontal), 1.17549435e-38));
  vec3 size = vec3(textureSize(scatter, 0));
  float first = ground ? 0.0 : float(kViewGroundTexels);
  float count = ground ? float(kViewGroundTexels) : size.x - float(kViewGroundTexels);
  a.u = (first + texelCoord(viewCoord(view, ray.mu, ground), count) * count) / size.x;
  a.azimuth = texelCoord(clamp(0.5 + 0.5 * cosAzimuth, 0.0, 1.0), size.y);
  a.peakPhase = air.peakLayer == kNoLayer ? 0.0 : phaseValue(air.peakPhase, air.peakG, dot(ray.dir, sun));
  a.light = sunIrradiance(air) * (1.0 / kSourceScale);
  return a;
}

// 1 - exp(-depth) without cancellation: below 0.01 the series is exact to depth^4/24 = 4e-10, above it the difference has seven digits less two.
vec3 airOpacity(vec3 depth) {
  return mix(1.0 - exp(-depth), depth * (1.0 - depth * (0.5 - depth * (1.0 / 6.0))), lessThan(depth, vec3(0.01)));
}

AirView airTo(sampler3D scatter, sampler2D depthRate, AirRay a, float distance_m) {
  AirView v;
  float t = clamp(distance_m - a.anchor_m, 0.0, a.length_m);
  float s = a.length_m > 0.0 ? t / a.length_m : 0.0;
  float slices = float(textureSize(depthRate, 0).y);
  float w = texelCoord(airSliceOf(a.slices, s), slices);
  vec3 depth = t * (1.0 / kRateLength_m) * textureLod(depthRate, vec2(a.u, w), 0.0).rgb;
  v.transmittance = exp(-depth);
  vec3 smoothPart = textureLod(scatter, vec3(a.u, a.azimuth, 0.5 * w), 0.0).rgb;
  vec3 peakPart = textureLod(scatter, vec3(a.u, a.azimuth, 0.5 + 0.5 * w), 0.0).rgb;
  v.inscatter = airOpacity(depth) * (smoothPart + a.peakPhase * peakPart) * a.light;
  return v;
}

// From the camera to `distance_m` along the pixel's ray, or to the ground or the shell's exit if that is nearer. The tables are
// for the sun and the camera that `view` describes.
AirView airAlong(sampler3D scatter, sampler2D depth, AirParams air, AirViewFrame view, Ray ray, float distance_m) {
  return airTo(scatter, depth, airRay(scatter, air, view, ray), distance_m);
}
