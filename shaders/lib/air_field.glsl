// The field of diffuse light (everything but the sun itself) at an altitude and sun zenith angle, as moments over real spherical
// harmonics about the direction towards the sun, azimuth from the vertical: the light of a planet lit by one sun is even in it, and a
// forward peak needs azimuth 0 only. All m up to degree FIELD_DEGREE, then m = 0 alone up to FIELD_ZONAL. A medium with Legendre moments
// chi_l scatters the field into the direction w as  sum_lm chi_l Y_lm(w) integral Y_lm L  (addition theorem).
// Layer lm of the table: the moment over that of l = 0, which is stored as its logarithm: light falls exponentially in twilight and with
// depth; over the m-th power of the sine of the sun's zenith angle (azimuthal).
#include "lib/air.glsl"

#ifndef READ_DEGREE
#define READ_DEGREE FIELD_DEGREE
#define READ_ZONAL FIELD_ZONAL
#endif

const int kFieldCount = (FIELD_DEGREE + 1) * (FIELD_DEGREE + 2) / 2 + FIELD_ZONAL - FIELD_DEGREE;
const float kDark = 1e-30;        // stands for no light where logarithms are stored
const float kLeastSin2 = 0.09;    // nearer to the zenith moments with m > 0 are continued: over sin^m, errors of the quadrature would grow

// Y_lm without its factor sin^m cos(m azimuth); c: cosine of the angle from the sun.
float[kFieldCount] harmonics(float c) {
  float y[kFieldCount];
  y[0] = 0.28209479;
#if FIELD_DEGREE >= 1
  y[1] = 0.48860251 * c;
  y[2] = 0.48860251;
#endif
#if FIELD_DEGREE >= 2
  y[3] = 0.31539157 * (3.0 * c * c - 1.0);
  y[4] = 1.09254843 * c;
  y[5] = 0.54627422;
#endif
#if FIELD_DEGREE >= 3
  y[6] = 0.37317633 * c * (5.0 * c * c - 3.0);
  y[7] = 0.45704580 * (5.0 * c * c - 1.0);
  y[8] = 1.44530572 * c;
  y[9] = 0.59004359;
#endif
#if FIELD_DEGREE >= 4
  y[10] = 0.10578555 * (c * c * (35.0 * c * c - 30.0) + 3.0);
  y[11] = 0.66904654 * c * (7.0 * c * c - 3.0);
  y[12] = 0.47308735 * (7.0 * c * c - 1.0);
  y[13] = 1.77013077 * c;
  y[14] = 0.62583574;
#endif
#if FIELD_ZONAL > FIELD_DEGREE
  float before = 1.0, now = c;
  for (int l = 2; l <= FIELD_ZONAL; ++l) {
    float next = (float(2 * l - 1) * c * now - float(l - 1) * before) / float(l);
    before = now;
    now = next;
    if (l > FIELD_DEGREE) y[kFieldCount - 1 - FIELD_ZONAL + l] = sqrt(float(2 * l + 1) * kInv4Pi) * now;
  }
#endif
  return y;
}

// cos(m azimuth) times the m-th power of the sines of the angles from the sun to the direction (cosine c) and to the zenith, m = 0..4; mu:
// zenith cosine of the direction. The second sine is what moments of that m lack in the table, so that nothing there is singular with the
// sun in the zenith.
float[5] azimuthal(float mu, float muSun, float c) {
  float a = mu - muSun * c;
  float a2 = a * a, s2 = max(1.0 - c * c, 0.0) * max(1.0 - muSun * muSun, 0.0);
  return float[5](1.0, a, 2.0 * a2 - s2, a * (4.0 * a2 - 3.0 * s2), 8.0 * a2 * (a2 - s2) + s2 * s2);
}

vec2 fieldTexel(AirParams air, vec2 size, float altitude_m, float muSun) {
  return airTexel(vec2(sunCoord(air, muSun), altitudeCoord(air, altitude_m)), size);
}

// Where the table has the moment lm.
int momentLayer(int l, int m) { return l <= FIELD_DEGREE ? l * (l + 1) / 2 + m : kFieldCount - 1 - FIELD_ZONAL + l; }

// Radiance scattered per metre. weight[l]: sum over layers of scattering [1/m] times chi_l. READ_DEGREE, READ_ZONAL: how much of the series;
// FIELD_SIGNED: with the dips below 0 of the cut series, without which its mean would be too bright.
vec3 fieldSource(sampler2DArray field, vec2 uv, vec3 weight[FIELD_ZONAL + 1], float y[kFieldCount], float turn[5]) {
  vec3 sum = weight[0] * y[0];
  for (int l = 1; l <= READ_ZONAL; ++l) {
    vec3 part = vec3(0.0);
    for (int m = 0; m <= (l > READ_DEGREE ? 0 : l); ++m) {
      int i = momentLayer(l, m);
      part += y[i] * turn[m] * textureLod(field, vec3(uv, float(i)), 0.0).rgb;
    }
    sum += weight[l] * part;
  }
#if !FIELD_SIGNED
  sum = max(sum, vec3(0.0));  // a cut series may dip below 0
#endif
  return sum * exp(textureLod(field, vec3(uv, 0.0), 0.0).rgb);
}
