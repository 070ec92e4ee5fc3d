// What lies behind the clouds, and how clouds and air go over it.
#include "lib/air.glsl"
#include "lib/ground.glsl"

struct Surroundings {
  vec3 sunDir;          // towards the sun, planet frame
  vec3 sunIrradiance;   // at the planet
  float sunRadius_rad, pixel_rad;
  float radius_m;
};

// Zenith cosine of the sun and normal at the point where the ray meets the ground: normal = (camera + t dir) / R.
vec3 groundNormal(CameraBlock camera, Ray ray) {
  dvec3 p = xyz(camera.position) + dvec3(ray.dir) * double(ray.ground_m);
  return normalize(vec3(p));
}

// Air and cloud are two quadratures: the clear air as far as the cloud shows over its opaque part, and as far as the background
// over the rest; cloud and background are dimmed by the air in front of them. `cloud`: premultiplied radiance, transmittance.
vec3 layers(vec4 cloud, AirView toCloud, AirView toBackground, vec3 background) {
  return toCloud.inscatter * (1.0 - cloud.a) + toBackground.inscatter * cloud.a + toCloud.transmittance * cloud.rgb +
         toBackground.transmittance * background * cloud.a;
}
