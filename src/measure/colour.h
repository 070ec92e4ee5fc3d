#pragma once
// The sRGB transfer curve (IEC 61966-2-1), both ways, for values 0..1.
#include <cmath>

namespace welkin::measure {

inline double srgbFromLinear(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }
inline double linearFromSrgb(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

}  // namespace welkin::measure
