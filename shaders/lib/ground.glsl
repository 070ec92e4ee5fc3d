// The planet's surface and the sun's disc.
#include "welkin/shared/ground.glsl.h"

// Equirectangular picture, north up, longitude 0 in the middle of its width. pixel_m: footprint of the picture's pixel on the ground.
vec3 groundAlbedoFrom(sampler2D map, vec3 normal, float radius_m, float pixel_m) {
  vec2 size = vec2(textureSize(map, 0));
  float level = log2(max(pixel_m * size.y / (kPi * radius_m), 1.0));
  vec2 uv = vec2(0.5 + atan(normal.y, normal.x) / (2.0 * kPi), 0.5 - asin(clamp(normal.z, -1.0, 1.0)) / kPi);
  return textureLod(map, uv, level).rgb;
}

// Radiance of the sun's disc, averaged over the pixel's rim; irradiance: at the planet. Linear limb darkening I(m)/I(1) = 1 - u (1 - m)
// with u = 0.47, 0.62, 0.78 at 680, 550, 440 nm (fits to the solar limb, Allen 1976), whose mean over the disc is 1 - u / 3.
vec3 sunDisc(vec3 dir, vec3 toSun, float radius_rad, float pixel_rad, vec3 irradiance) {
  if (radius_rad <= 0.0) return vec3(0.0);  // a point has no disc to draw
  float angle = 2.0 * asin(min(0.5 * length(dir - toSun), 1.0));  // the chord does not cancel as the cosine would
  float cover = clamp((radius_rad - angle) / pixel_rad + 0.5, 0.0, 1.0);
  float rho = min(angle / radius_rad, 1.0);
  vec3 u = vec3(0.47, 0.62, 0.78);
  vec3 limb = (1.0 - u * (1.0 - sqrt(1.0 - rho * rho))) / (1.0 - u / 3.0);
  return cover * limb * irradiance / (kPi * radius_rad * radius_rad);
}
