// The planet's surface and the sun's disc.
#include "welkin/shared/ground.glsl.h"

// Equirectangular picture, north up, longitude 0 in the middle of its width. pixel_m: footprint of the picture's pixel on the ground.
vec3 groundAlbedoFrom(sampler2D map, float turn, vec3 normal, float radius_m, float pixel_m) {
  vec2 size = vec2(textureSize(map, 0));
  float level = log2(max(pixel_m * size.y / (kPi * radius_m), 1.0));
  vec2 uv = vec2(0.5 + turn + atan(normal.y, normal.x) / (2.0 * kPi), 0.5 - asin(clamp(normal.z, -1.0, 1.0)) / kPi);
  return textureLod(map, uv, level).rgb;
}

// Radiance of the sun's disc, averaged over the pixel; irradiance: at the planet. Linear limb darkening I(m)/I(1) = 1 - u (1 - m)
// with u = 0.47, 0.62, 0.78 at 680, 550, 440 nm (fits to the solar limb, Allen 1976), whose mean over the disc is 1 - u / 3.
// Coverage falls over the width p of a pixel around the radius R: an area of pi (R^2 + p^2 / 12), so R^2 = r^2 - p^2 / 12 keeps the disc's
// own. Below r = p / sqrt(3) the shape is a cone of the width of two pixels that keeps the disc's light: 0.94 to 1.12 of it wherever it
// falls between the pixels. Limb darkening goes out with it, and is stretched so that the rim's pixels share in it (light within 3 %).
vec3 sunDisc(vec3 dir, vec3 toSun, float radius_rad, float pixel_rad, vec3 irradiance) {
  if (radius_rad <= 0.0) return vec3(0.0);  // a point has no disc to draw
  float angle = 2.0 * asin(min(0.5 * length(dir - toSun), 1.0));  // the chord does not cancel as the cosine would
  float r2 = radius_rad * radius_rad, p2 = pixel_rad * pixel_rad, drawn2 = max(r2, p2 / 3.0);
  float cover = clamp((sqrt(drawn2 - p2 / 12.0) - angle) / pixel_rad + 0.5, 0.0, 1.0);
  float rho2 = min(angle * angle / (r2 + 0.5 * p2), 1.0);
  vec3 u = vec3(0.47, 0.62, 0.78);
  vec3 limb = (1.0 - u * (1.0 - sqrt(1.0 - rho2))) / (1.0 - u / 3.0);
  return cover * mix(limb, vec3(1.0), p2 / (3.0 * drawn2)) * irradiance / (kPi * drawn2);
}
