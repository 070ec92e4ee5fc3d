#include "welkin/clouds/noise_bounds.h"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

// Greatest slope of the fade 6t^5 - 15t^4 + 10t^3 on [a, b]: f' = 30 t^2 (1-t)^2 rises to the middle.
float fadeSlope(float a, float b) {
  const auto slope = [](float t) { return 30 * t * t * (1 - t) * (1 - t); };
  if (a <= 0.5f && b >= 0.5f) return 1.875f;
  return std::max(slope(a), slope(b));
}

}  // namespace

Interval noiseInterval(glm::uvec3 corner, std::uint32_t sizeShift, std::uint32_t shift, std::uint32_t zShift, std::uint32_t seed) {
  if (sizeShift > shift || sizeShift > zShift) return {-1, 1};
  const float half[3] = {std::ldexp(0.5f, static_cast<int>(sizeShift) - static_cast<int>(shift)),
                         std::ldexp(0.5f, static_cast<int>(sizeShift) - static_cast<int>(shift)),
                         std::ldexp(0.5f, static_cast<int>(sizeShift) - static_cast<int>(zShift))};
  // with slopes of at least about 1 the interval is the whole range long before this
  if (half[2] > 0.4f) return {-1, 1};
  const float t[3] = {shared::cellFraction(corner.x, shift) + half[0], shared::cellFraction(corner.y, shift) + half[1],
                      shared::cellFraction(corner.z, zShift) + half[2]};
  float g[8][3], v[8];  // gradients and their planes' values at the centre, corner index x + 2y + 4z
  for (std::uint32_t c = 0; c < 8; ++c) {
    const std::uint32_t h = shared::mixBits(shared::latticeX(corner.x, shift, c & 1u) ^ seed ^
                                            shared::latticeY(corner.y, shift, (c >> 1) & 1u) ^ shared::latticeZ(corner.z, zShift, c >> 2));
    for (std::uint32_t a = 0; a < 3; ++a) g[c][a] = static_cast<float>((h >> (10 * a)) & 1023u) - 511.5f;
    g[c][2] = static_cast<float>(h >> 22) - 511.5f;
    v[c] = 0;
    for (std::uint32_t a = 0; a < 3; ++a) v[c] += g[c][a] * (t[a] - static_cast<float>((c >> a) & 1u));
  }
  float f[3], reach = 0;
  for (int a = 0; a < 3; ++a) f[a] = shared::noiseFade(t[a]);
  float centre = 0;
  for (int c = 0; c < 8; ++c) centre += v[c] * (c & 1 ? f[0] : 1 - f[0]) * (c & 2 ? f[1] : 1 - f[1]) * (c & 4 ? f[2] : 1 - f[2]);
  // n(x) = sum w_c(x) (v_c + g_c . (x - centre)). The planes move by at most max |g| h along each axis (weights add up to 1); the
  // weights then move between the centre's values: along an axis by f' times the greatest difference over one of its four edges.
  for (int a = 0; a < 3; ++a) {
    float steepest = 0, difference = 0;
    for (int c = 0; c < 8; ++c) {
      steepest = std::max(steepest, std::abs(g[c][a]));
      if (!((c >> a) & 1)) difference = std::max(difference, std::abs(v[c | (1 << a)] - v[c]));
    }
    reach += half[a] * (steepest + fadeSlope(t[a] - half[a], t[a] + half[a]) * difference);
  }
  const float slack = 1e-5f;  // rounding of the sum of eight terms
  return {std::clamp((centre - reach) * shared::kNoiseScale - slack, -1.0f, 1.0f),
          std::clamp((centre + reach) * shared::kNoiseScale + slack, -1.0f, 1.0f)};
}

Interval billowInterval(Interval n, float billow) {
  // plain and billow parts: piecewise linear in n with one kink at 0
  float lo = std::min(shared::billowNoise(n.lo, billow), shared::billowNoise(n.hi, billow));
  float hi = std::max(shared::billowNoise(n.lo, billow), shared::billowNoise(n.hi, billow));
  if (n.lo < 0 && n.hi > 0) lo = std::min(lo, shared::billowNoise(0, billow));
  return {lo, hi};
}

}  // namespace welkin
