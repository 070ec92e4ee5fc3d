// The picture: ground, sun, air and the cloud layer, in linear radiance, and tone-mapped where the exposure is known beforehand.
#include "lib/composite.glsl"
#include "welkin/shared/bindings.glsl.h"
#include "welkin/shared/counters.glsl.h"
#include "welkin/shared/tonemap.glsl.h"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std140, binding = WK_CAMERA_BINDING) uniform CameraUniforms { CameraBlock camera; };
layout(std430, binding = WK_COUNTERS_BINDING) buffer CounterBuffer { Counters counters; };
#if OPT_LINEAR
layout(rgba32f, binding = 0) uniform writeonly image2D u_radiance;
#endif
#if OPT_DISPLAY
layout(rgba8, binding = 1) uniform writeonly image2D u_display;
#endif
#ifdef DEBUG_VIEW
#include "welkin/shared/debug.glsl.h"
layout(r32f, binding = 0) uniform writeonly image2D u_value;
#endif
#if OPT_AIR
layout(std140, binding = WK_AIR_PARAMS_BINDING) uniform AirUniforms { AirBlock u_air; };
layout(binding = WK_SKY_TRANSMITTANCE_UNIT) uniform sampler2D u_skyTransmittance;
layout(binding = WK_SKY_IRRADIANCE_UNIT) uniform sampler2D u_skyIrradiance;
layout(binding = WK_SKY_VIEW_SCATTER_UNIT) uniform sampler3D u_viewScatter;
layout(binding = WK_SKY_VIEW_TRANSMITTANCE_UNIT) uniform sampler2D u_viewDepth;
#endif
#if OPT_CLOUDS
layout(binding = WK_CLOUD_LIGHT_UNIT) uniform sampler2D u_cloudLight;
#if OPT_AIR || OPT_GROUND
layout(binding = WK_CLOUD_AUX_UNIT) uniform sampler2D u_cloudAux;
#endif
#endif
#if OPT_ALBEDO_MAP
layout(binding = WK_ALBEDO_UNIT) uniform sampler2D u_albedoMap;
uniform float u_groundTurn;  // of the ground under clouds that drift, in turns
#endif
uniform ivec2 u_size;
uniform vec3 u_albedo, u_sunDir, u_sunIrradiance;
uniform float u_sunRadius_rad, u_pixel_rad, u_exposure;

vec3 groundLight(Ray ray, float visibility) {
  vec3 normal = groundNormal(camera, ray);
  vec3 albedo = u_albedo;
#if OPT_ALBEDO_MAP
  albedo = groundAlbedoFrom(u_albedoMap, u_groundTurn, normal, float(camera.forward.w), ray.ground_m * u_pixel_rad);
#endif
  vec3 sun = u_sunIrradiance * visibility, sky = vec3(0.0);
#if OPT_AIR && OPT_SUN
  float muSun = dot(normal, u_sunDir);
  sun *= airSunTransmittance(u_skyTransmittance, u_air.params, 0.0, muSun);
  sky = airSkyIrradiance(u_skyIrradiance, u_air.params, 0.0, muSun).fromAbove;
#endif
  return groundRadiance(albedo, normal, u_sunDir, -ray.dir, sun, sky);
}

vec3 background(Ray ray, float visibility) {
  vec3 light = vec3(0.0);
#if OPT_SUN
#if OPT_GROUND
  if (ray.ground_m >= 0.0) light = groundLight(ray, visibility);
  else
#endif
    light = sunDisc(ray.dir, u_sunDir, u_sunRadius_rad, u_pixel_rad, u_sunIrradiance);
#endif
  return light;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, u_size))) return;
  vec2 ndc = (vec2(pixel) + 0.5) / vec2(u_size) * vec2(2.0, -2.0) + vec2(-1.0, 1.0);
  Ray ray = cameraRay(camera, ndc);
  vec4 cloud = vec4(0.0, 0.0, 0.0, 1.0);
  vec2 aux = vec2(0.0, 1.0);
#if OPT_CLOUDS
  cloud = texelFetch(u_cloudLight, pixel, 0);
#if OPT_AIR || OPT_GROUND
  aux = texelFetch(u_cloudAux, pixel, 0).xy;
#endif
#endif
  vec3 light = background(ray, aux.y);
#if OPT_AIR
  AirRay air = airRay(u_viewScatter, u_air.params, u_air.view, ray);
  AirView toBackground = airTo(u_viewScatter, u_viewDepth, air, air.anchor_m + air.length_m);
  AirView toCloud = AirView(vec3(0.0), vec3(1.0));
#if OPT_CLOUDS
  // A loop of none or one turn: software rasterisers run both sides of an `if`, but end a loop when no pixel of the vector needs it.
  for (int i = 0; i < (cloud.a < 1.0 ? 1 : 0); ++i) toCloud = airTo(u_viewScatter, u_viewDepth, air, aux.x);
#endif
  light = layers(cloud, toCloud, toBackground, light);
#else
  light = cloud.rgb + cloud.a * light;
#endif
#if OPT_DISPLAY
  vec3 shown = displayValues(TONE_CURVE(toneInput(light, u_exposure)), uint(pixel.x), uint(pixel.y));
#endif
  bool broken = any(isnan(light)) || any(isinf(light)) || isnan(cloud.a) || isnan(aux.x);
#ifdef DEBUG_VIEW  // beside the picture, which has counted
#if DEBUG_VIEW == WK_DEBUG_NAN
  bool negative = any(lessThan(light, vec3(0.0)));
  imageStore(u_value, pixel, vec4(broken ? 1.0 : negative ? 2.0 : 0.0));
  shown = vec3(0.8 * dot(shown, vec3(0.3, 0.6, 0.1)));
  broken = broken || negative;
#else
  imageStore(u_value, pixel, vec4(luminance(light)));
#endif
#else
  if (broken) {
    atomicAdd(counters.nanPixels, 1u);
    light = kNanPaint;
  }
#endif
#if OPT_LINEAR
  imageStore(u_radiance, pixel, vec4(light, 1.0 - cloud.a));
#endif
#if OPT_DISPLAY
  imageStore(u_display, pixel, vec4(broken ? kNanPaint : shown, 1.0));
#endif
}
