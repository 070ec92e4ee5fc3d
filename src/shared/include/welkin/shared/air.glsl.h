#pragma once
// The clear air of a planet: up to six layers, each with a profile over altitude and a phase function. Structs are scalars only and
// multiples of 16 bytes, so that std140, std430 and C++ agree on every offset.
#include "welkin/shared/camera.glsl.h"
#include "welkin/shared/phase.glsl.h"
WK_BEGIN

WK_CONST uint kMaxAirLayers = 6u;
WK_CONST uint kProfileExponential = 0u;  // exp(-h a): a = 1 / scale height [1/m]
WK_CONST uint kProfileTent = 1u;         // max(0, 1 - |h - a| b): a peak [m], b = 1 / half width [1/m]
WK_CONST uint kProfileUniform = 2u;      // 1 in [a, b] [m]
WK_CONST uint kNoLayer = 0xFFFFFFFFu;

struct AirLayer {
  float scatteringR, scatteringG, scatteringB, a;  // 1/m where the profile is 1; 680, 550, 440 nm
  float absorptionR, absorptionG, absorptionB, b;
  uint profile, phase;
  float g;
  float forward;                         // part of the scattering that many orders count as going straight on (air.cpp: setMoments)
  vec4 moments[4];                       // Legendre moments 0..15 of the phase function; 0 is 1
};

struct AirParams {
  float radius_m, top_m, sunRadius_rad;  // planet, height of the shell, angular radius of the sun
  uint layerCount;
  float sunR, sunG, sunB;                // irradiance at the planet, on a plane facing the sun
  float peakG;                           // of peakLayer
  float albedoR, albedoG, albedoB;       // ground, mean
  uint peakLayer;                        // the layer whose phase function is too sharp to be stored in tables, or kNoLayer
  uint peakPhase;
  float altitudeScale_m, altitudeNorm;   // of altitudeCoord
  float sunBend, sunNight;               // of sunCoord
  float sunCos, sunSin;                  // of the sun's angular radius
  float hazeTop;                         // 0..1: how far up the air hides what is below (air.cpp)
};

// What look-ups need of the camera the view tables were made for. The anchor is the camera, or outside the shell the ray's entry.
struct AirViewFrame {
  float upX, upY, upZ, muHorizon;        // camera's radial direction; cosine of the horizon's zenith angle at the anchor
  float axisX, axisY, axisZ, skyEnd;     // horizontal unit vector towards the sun; skyEnd: chord (below) at the sky table's last texel
  float sunX, sunY, sunZ, skyChord;      // towards the sun; chord of the horizon, seen from the zenith
  float anchorAltitude_m, groundChord;   // chord of the horizon, seen from the nadir
  float skySlices, groundSlices;         // slice spacing (airSliceOf)
  float cosSun, sinSun;                  // of the sun's zenith angle at the camera
  float anchorOverCentre;                // anchor radius / camera's distance from the centre: 1 inside the shell
  float spare;
};

struct AirBlock {
  AirParams params;
  AirViewFrame view;
  AirLayer layers[6];
};

WK_FN vec3 sunIrradiance(AirParams p) { return vec3(p.sunR, p.sunG, p.sunB); }
WK_FN vec3 groundAlbedo(AirParams p) { return vec3(p.albedoR, p.albedoG, p.albedoB); }
WK_FN vec3 layerScattering(AirLayer l) { return vec3(l.scatteringR, l.scatteringG, l.scatteringB); }
WK_FN vec3 layerExtinction(AirLayer l) {
  return vec3(l.scatteringR + l.absorptionR, l.scatteringG + l.absorptionG, l.scatteringB + l.absorptionB);
}

// What is left of it where light scattered straight on counts as not scattered.
WK_FN vec3 layerReducedExtinction(AirLayer l) { return layerExtinction(l) - layerScattering(l) * l.forward; }

// Density of a layer as a fraction of its reference value.
WK_FN float layerDensity(AirLayer l, float altitude_m) {
  float h = max(altitude_m, F(0.0));
  if (l.profile == kProfileExponential) return exp(-h * l.a);
  if (l.profile == kProfileTent) return max(F(0.0), F(1.0) - abs(h - l.a) * l.b);
  return h >= l.a && h <= l.b ? F(1.0) : F(0.0);
}

// Reduced extinction of all layers, 1/m.
WK_FN vec3 airExtinction(AirBlock air, float altitude_m) {
  vec3 sum = vec3(F(0.0));
  for (uint i = 0u; i < air.params.layerCount; ++i)
    sum += layerReducedExtinction(air.layers[i]) * layerDensity(air.layers[i], altitude_m);
  return sum;
}

// sqrt(r^2 - R^2) for altitude h: distance to the horizon.
WK_FN float horizonDistance(float radius_m, float altitude_m) { return sqrt(altitude_m * (F(2.0) * radius_m + altitude_m)); }

// Cosine of the zenith angle of the geometric horizon.
WK_FN float horizonCosine(float radius_m, float altitude_m) {
  return -horizonDistance(radius_m, altitude_m) / (radius_m + altitude_m);
}

// Distance from altitude h to the shell's top along zenith cosine mu, cancellation-free.
WK_FN float distanceToTop(AirParams p, float altitude_m, float mu) {
  float b = (p.radius_m + altitude_m) * mu;
  float c = (p.top_m - altitude_m) * (F(2.0) * p.radius_m + p.top_m + altitude_m);
  float root = sqrt(b * b + c);
  return mu > F(0.0) ? c / (root + b) : root - b;
}

// Distance to the ground along mu below the horizon, cancellation-free. On the horizon itself rounding may leave a root of
// slightly less than nothing, hence the max.
WK_FN float distanceToGround(AirParams p, float altitude_m, float mu) {
  float b = -(p.radius_m + altitude_m) * mu;
  float c = altitude_m * (F(2.0) * p.radius_m + altitude_m);
  float root = sqrt(max(b * b - c, F(0.0)));
  return c > F(0.0) ? c / (b + root) : F(0.0);
}

// Fraction of the sun's disc above the planet's edge, from altitude h. muSun: cosine of the zenith angle of its centre.
WK_FN float sunVisible(AirParams p, float altitude_m, float muSun) {
  float r = p.radius_m + altitude_m;
  // d(cos)/d(angle) at the horizon is R / r
  float above_rad = (muSun - horizonCosine(p.radius_m, altitude_m)) * r / p.radius_m;
  if (p.sunRadius_rad <= F(0.0)) return above_rad > F(0.0) ? F(1.0) : F(0.0);
  float x = clamp(above_rad / p.sunRadius_rad, F(-1.0), F(1.0));
  // A disc's segment: (acos y - y sqrt(1 - y^2)) / pi = (1 - y)^(3/2) times a smooth function; its quadratic fit is within 3e-5.
  float rest = F(1.0) - abs(x);
  float segment = rest * sqrt(rest) * (F(0.5) + abs(x) * (F(0.1126894) - F(0.0133469) * abs(x)));
  return x > F(0.0) ? F(1.0) - segment : segment;
}

// Cosine of the zenith angle of the sun disc's upper edge.
WK_FN float sunEdgeCosine(AirParams p, float muSun) {
  return muSun * p.sunCos + sqrt(max(F(1.0) - muSun * muSun, F(0.0))) * p.sunSin;
}

// Optical depth from altitude h along mu (not into the ground) over `length_m`, starting densely: two-point Gauss quadrature on
// `panels` panels of t = length x^2.
WK_FN vec3 airOpticalDepth(AirBlock air, float altitude_m, float mu, float length_m, uint panels) {
  vec3 sum = vec3(F(0.0));
  float width = F(1.0) / float(panels);
  for (uint i = 0u; i < 2u * panels; ++i) {
    float offset = (i & 1u) == 0u ? F(0.211324865405187) : F(0.788675134594813);
    float x = (float(i >> 1u) + offset) * width;
    float h = altitudeAlong(altitude_m, mu, length_m * x * x, air.params.radius_m);
    sum += airExtinction(air, h) * x;
  }
  return sum * (width * length_m);  // dt = 2 length x dx, half a panel each
}

// Optical depth to the shell's top along a ray that misses the ground. A ray that first descends is split at its lowest point, so
// that both halves start densely where the air is thickest.
WK_FN vec3 airOpticalDepthToTop(AirBlock air, float altitude_m, float mu, uint panels) {
  if (mu >= F(0.0)) return airOpticalDepth(air, altitude_m, mu, distanceToTop(air.params, altitude_m, mu), panels);
  float r = air.params.radius_m + altitude_m;
  float toLowest = -r * mu;
  float lowest = max(altitudeAlong(altitude_m, mu, toLowest, air.params.radius_m), F(0.0));
  return airOpticalDepth(air, lowest, F(0.0), toLowest, panels) +
         airOpticalDepth(air, lowest, F(0.0), distanceToTop(air.params, lowest, F(0.0)), panels);
}

// --- Table coordinates, all 0..1 ---

// Altitude, even in its logarithm well above altitudeScale_m (the thinnest layer's), linear below.
WK_FN float altitudeCoord(AirParams p, float altitude_m) {
  return clamp(log(F(1.0) + max(altitude_m, F(0.0)) / p.altitudeScale_m) * p.altitudeNorm, F(0.0), F(1.0));
}
WK_FN float coordAltitude(AirParams p, float coord) { return min(p.altitudeScale_m * (exp(coord / p.altitudeNorm) - F(1.0)), p.top_m); }

// Sun's zenith cosine: a part kNightTexels of the texels from -sunNight (below it is no light) to 0, the others up to 1; on each side
// 1 + sunBend times as dense at the horizon as on average.
WK_CONST float kNightTexels = F(0.4);
WK_FN float sunCoord(AirParams p, float mu) {
  float side = mu < F(0.0) ? max(mu / p.sunNight, F(-1.0)) : mu;
  return kNightTexels + (F(1.0) + p.sunBend) * side / (F(1.0) + p.sunBend * abs(side)) * (mu < F(0.0) ? kNightTexels : F(1.0) - kNightTexels);
}
WK_FN float sunCosine(AirParams p, float coord) {
  float side = coord < kNightTexels ? coord / kNightTexels - F(1.0) : (coord - kNightTexels) / (F(1.0) - kNightTexels);
  float mu = side / (F(1.0) + p.sunBend * (F(1.0) - abs(side)));
  return coord < kNightTexels ? mu * p.sunNight : mu;
}

// Optical depth to the top: x along the distance to the top (Bruneton and Neyret 2008); y the square root of the altitude's
// coordinate, because along the horizon the depth grows with the square root of the altitude.
WK_FN vec2 transmittanceCoord(AirParams p, float altitude_m, float mu) {
  float dMin = p.top_m - altitude_m;
  float dMax = horizonDistance(p.radius_m, altitude_m) + horizonDistance(p.radius_m, p.top_m);
  return vec2((distanceToTop(p, altitude_m, mu) - dMin) / (dMax - dMin), sqrt(altitudeCoord(p, altitude_m)));
}
// Inverse: altitude in m, zenith cosine.
WK_FN vec2 transmittancePoint(AirParams p, vec2 coord) {
  float h = coordAltitude(p, coord.y * coord.y);
  float dMin = p.top_m - h;
  float dMax = horizonDistance(p.radius_m, h) + horizonDistance(p.radius_m, p.top_m);
  float d = dMin + coord.x * (dMax - dMin);
  float mu = d > F(0.0) ? ((p.top_m - h) * (F(2.0) * p.radius_m + p.top_m + h) - d * d) / (F(2.0) * (p.radius_m + h) * d) : F(1.0);
  return vec2(h, clamp(mu, F(-1.0), F(1.0)));
}

// View direction at the anchor. e = sqrt(1 - |cos|) is the chord of the angle from the zenith (or nadir, below the horizon): nearly
// uniform in angle; the square root of the chord's distance from the horizon's makes the texels quadratically dense there.
// 0 on the horizon, 1 at the other end.
WK_FN float viewCoord(AirViewFrame v, float mu, bool ground) {
  float above = ground ? v.muHorizon - mu : mu - v.muHorizon;
  float e = sqrt(max(ground ? F(1.0) + mu : F(1.0) - mu, F(0.0)));
  float horizon = ground ? v.groundChord : v.skyChord;
  // horizon - e without cancellation: the difference of the squares is `above`
  float x = above / ((horizon + e) * (horizon - (ground ? F(0.0) : v.skyEnd)));
  return sqrt(clamp(x, F(0.0), F(1.0)));
}
WK_FN float viewCosine(AirViewFrame v, float coord, bool ground) {
  float horizon = ground ? v.groundChord : v.skyChord;
  float off = coord * coord * (horizon - (ground ? F(0.0) : v.skyEnd));
  float above = off * (F(2.0) * horizon - off);  // horizon^2 - e^2
  return clamp(ground ? v.muHorizon - above : v.muHorizon + above, F(-1.0), F(1.0));
}

// Slices along a ray's segment in the air: fraction of its length for slice coordinate x; w = -1 dense at the start, 0 even, 1 dense
// at the end. And the inverse.
WK_FN float airSliceAt(float w, float x) { return x * (F(1.0) + w * (F(1.0) - x)); }
WK_FN float airSliceOf(float w, float s) {
  float b = F(1.0) + w;
  float root = sqrt(max(b * b - F(4.0) * w * s, F(0.0)));
  return s > F(0.0) ? F(2.0) * s / (b + root) : F(0.0);
}

// Coordinate 0..1 over texel centres of a table of n texels.
WK_FN float texelCoord(float x, float n) { return (F(0.5) + x * (n - F(1.0))) / n; }

// Sizes of the tables.
WK_CONST uint kTransmittanceWidth = 256u, kTransmittanceHeight = 64u;
WK_CONST uint kViewGroundTexels = 48u, kViewSkyTexels = 112u;             // view direction below and above the horizon
WK_CONST uint kViewAzimuths = 24u, kViewSlices = 17u;
WK_CONST uint kDiffuseGroundTexels = 16u, kDiffuseSkyTexels = 32u;        // the same for diffuse light alone
WK_CONST uint kDiffuseAzimuths = 16u, kDiffuseSlices = 9u;

WK_CONST float kNoDepth = F(1e-12);  // optical depth that stands for none where logarithms are stored
WK_CONST float kRateLength_m = F(100000.0);  // of optical depth per length in tables: fits 16-bit floats
WK_CONST float kSourceScale = F(4096.0);     // of sources over extinction, which are at most 1: 16-bit floats hold 1.5e-8 to 16

WK_END
