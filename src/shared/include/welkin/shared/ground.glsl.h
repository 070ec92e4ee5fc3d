#pragma once
// Light that leaves the ground: a Lambert surface, and where the ground looks like water the glitter of a wind-roughened sea.
#include "welkin/shared/phase.glsl.h"
WK_BEGIN

// How much a surface of this albedo is open water, 0..1: dark and bluer than red. A guess from colour alone, for plain colours and
// satellite pictures.
WK_FN float waterFraction(vec3 albedo) {
  float blue = clamp((albedo.z - F(1.25) * albedo.x) / max(F(0.35) * albedo.x, F(1e-4)), F(0.0), F(1.0));
  float dark = clamp((F(0.25) - albedo.y) * F(10.0), F(0.0), F(1.0));
  return blue * dark;
}

// Fresnel reflectance of water (n = 1.33) by Schlick's fit: R0 = ((n-1)/(n+1))^2 = 0.02.
WK_FN float waterFresnel(float cosine) {
  float m = F(1.0) - clamp(cosine, F(0.0), F(1.0));
  float m2 = m * m;
  return F(0.02) + F(0.98) * m2 * m2 * m;
}

// Reflected radiance per unit of the sun's irradiance (on a plane facing it). Cox and Munk 1954: slopes are Gaussian with mean square
// 0.003 + 0.00512 wind [m/s]; here 6 m/s. normal, toSun, toCamera: unit. Waves that hide each other from the sun and from the viewer:
// Smith's masking for Gaussian slopes, x / (x + 0.6 s) for slope deviation s an axis, which is within 10 % of it and keeps the
// quotient finite at grazing angles.
WK_FN float waterGlint(vec3 normal, vec3 toSun, vec3 toCamera) {
  const float kSlope2 = F(0.0337), kHide = F(0.078);
  float nl = max(dot(normal, toSun), F(0.0)), nv = max(dot(normal, toCamera), F(0.0));
  vec3 h = normalize(toSun + toCamera);
  float nh = max(dot(normal, h), F(0.05));  // slopes over 20 have no weight left: exp(-400 / kSlope2)
  float nh2 = nh * nh;
  float slopes = exp((nh2 - F(1.0)) / (nh2 * kSlope2)) / (kPi * kSlope2 * nh2 * nh2);
  return waterFresnel(dot(h, toCamera)) * slopes * nl / (F(4.0) * (nl + kHide) * (nv + kHide));
}

// Radiance towards the camera. sunIrradiance: of a plane facing the sun, with air, cloud shadow and planet shadow in it;
// skyIrradiance: of the ground from above.
WK_FN vec3 groundRadiance(vec3 albedo, vec3 normal, vec3 toSun, vec3 toCamera, vec3 sunIrradiance, vec3 skyIrradiance) {
  float nl = max(dot(normal, toSun), F(0.0));
  vec3 diffuse = albedo * (F(1.0) / kPi) * (sunIrradiance * nl + skyIrradiance);
  float water = waterFraction(albedo);
  // Mean reflectance of a rough sea at grazing view stays near 0.3 (slopes face the viewer), so Fresnel's cosine is floored too.
  float mirror = water * waterFresnel(max(dot(normal, toCamera), F(0.18)));
  vec3 glint = sunIrradiance * (water * waterGlint(normal, toSun, toCamera));
  return diffuse * (F(1.0) - mirror) + skyIrradiance * (mirror / kPi) + glint;
}

WK_END
