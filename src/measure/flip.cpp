#include "welkin/measure/flip.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "colour.h"

namespace welkin::measure {
namespace {

using glm::dvec3;
constexpr double kPi = std::numbers::pi;

// A plane of values with the edge repeated outside.
struct Plane {
  int width, height;
  std::vector<double> v;
  Plane(int w, int h) : width(w), height(h), v(std::size_t(w) * std::size_t(h)) {}
  double& at(int x, int y) { return v[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
  double clamped(int x, int y) const {
    return v[std::size_t(std::clamp(y, 0, height - 1)) * std::size_t(width) + std::size_t(std::clamp(x, 0, width - 1))];
  }
};

using Kernel = std::vector<double>;  // odd length, centre in the middle

Plane convolve(const Plane& in, const Kernel& alongX, const Kernel& alongY) {
  const int rx = int(alongX.size() / 2), ry = int(alongY.size() / 2);
  Plane half(in.width, in.height), out(in.width, in.height);
  for (int y = 0; y < in.height; ++y) {
    for (int x = 0; x < in.width; ++x) {
      double sum = 0;
      for (int i = -rx; i <= rx; ++i) sum += alongX[std::size_t(i + rx)] * in.clamped(x + i, y);
      half.at(x, y) = sum;
    }
  }
  for (int y = 0; y < in.height; ++y) {
    for (int x = 0; x < in.width; ++x) {
      double sum = 0;
      for (int i = -ry; i <= ry; ++i) sum += alongY[std::size_t(i + ry)] * half.clamped(x, y + i);
      out.at(x, y) = sum;
    }
  }
  return out;
}

Kernel gaussian(double sigma) {
  const int r = std::max(1, int(std::ceil(3 * sigma)));
  Kernel k;
  for (int i = -r; i <= r; ++i) k.push_back(std::exp(-i * i / (2 * sigma * sigma)));
  double sum = 0;
  for (const double v : k) sum += v;
  for (double& v : k) v /= sum;
  return k;
}

// First or second derivative of a Gaussian; positive and negative parts sum to 1 and -1 each, as the paper normalises them.
Kernel gaussianDerivative(double sigma, int order) {
  const int r = std::max(1, int(std::ceil(3 * sigma)));
  Kernel k;
  for (int i = -r; i <= r; ++i) {
    const double g = std::exp(-i * i / (2 * sigma * sigma));
    k.push_back(order == 1 ? -i * g : (i * i / (sigma * sigma) - 1) * g);
  }
  double positive = 0, negative = 0;
  for (const double v : k) (v > 0 ? positive : negative) += std::abs(v);
  for (double& v : k) v /= v > 0 ? positive : negative;
  return k;
}

// Rec. 709 primaries, white D65.
constexpr dvec3 kWhite{0.950428545, 1.0, 1.088900371};
dvec3 xyzFromRgb(dvec3 c) {
  return {0.412390799 * c.x + 0.357584339 * c.y + 0.180480788 * c.z, 0.212639006 * c.x + 0.715168679 * c.y + 0.072192315 * c.z,
          0.019330819 * c.x + 0.119194780 * c.y + 0.950532152 * c.z};
}
dvec3 rgbFromXyz(dvec3 c) {
  return {3.240969942 * c.x - 1.537383178 * c.y - 0.498610760 * c.z, -0.969243636 * c.x + 1.875967502 * c.y + 0.041555057 * c.z,
          0.055630080 * c.x - 0.203976959 * c.y + 1.056971514 * c.z};
}
// The opponent space of the paper: luminance, red-green, blue-yellow, linear in light.
dvec3 opponentFromXyz(dvec3 c) {
  const dvec3 n = c / kWhite;
  return {116 * n.y - 16, 500 * (n.x - n.y), 200 * (n.y - n.z)};
}
dvec3 xyzFromOpponent(dvec3 o) {
  const double y = (o.x + 16) / 116;
  return dvec3(o.y / 500 + y, y, y - o.z / 200) * kWhite;
}
// CIE L*a*b* with colour scaled by lightness (Hunt effect).
dvec3 huntLab(dvec3 rgb) {
  const dvec3 n = xyzFromRgb(rgb) / kWhite;
  const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
  const double l = 116 * f(n.y) - 16;
  return {l, 0.01 * l * 500 * (f(n.x) - f(n.y)), 0.01 * l * 200 * (f(n.y) - f(n.z))};
}
double hyab(dvec3 a, dvec3 b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

struct Seen {  // a picture as the eye gets it
  std::vector<dvec3> lab;
  std::vector<double> edge, point;
};

Seen see(const Image8& image, double ppd) {
  const int w = image.width, h = image.height;
  std::array<Plane, 3> opponent{Plane(w, h), Plane(w, h), Plane(w, h)};
  Plane luminance(w, h);
  const std::size_t n = luminance.v.size();
  for (std::size_t i = 0; i < n; ++i) {
    dvec3 rgb;
    for (int c = 0; c < 3; ++c) rgb[c] = linearFromSrgb(image.rgba[4 * i + std::size_t(c)] / 255.0);
    const dvec3 o = opponentFromXyz(xyzFromRgb(rgb));
    for (int c = 0; c < 3; ++c) opponent[std::size_t(c)].v[i] = o[c];
    luminance.v[i] = (o.x + 16) / 116;
  }
  // Contrast sensitivity as Gaussians exp(-pi^2 x^2 / b), x in degrees; sums of two for blue-yellow (paper, table 1).
  struct Lobe {
    double a, b;
  };
  const std::array<std::array<Lobe, 2>, 3> sensitivity{{{{{1, 0.0047}, {0, 1}}}, {{{1, 0.0053}, {0, 1}}}, {{{34.1, 0.04}, {13.5, 0.025}}}}};
  std::array<Plane, 3> filtered = opponent;
  for (std::size_t c = 0; c < 3; ++c) {
    double total = 0;
    std::fill(filtered[c].v.begin(), filtered[c].v.end(), 0.0);
    for (const auto& lobe : sensitivity[c]) {
      if (lobe.a == 0) continue;
      const double sigma = std::sqrt(lobe.b / (2 * kPi * kPi)) * ppd;
      const double weight = lobe.a * std::sqrt(kPi / lobe.b) * lobe.b;  // a sqrt(pi / b) exp(..) over the plane, times pi
      const Kernel k = gaussian(sigma);
      const Plane blurred = convolve(opponent[c], k, k);
      for (std::size_t i = 0; i < n; ++i) filtered[c].v[i] += weight * blurred.v[i];
      total += weight;
    }
    for (double& v : filtered[c].v) v /= total;
  }
  Seen out;
  out.lab.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const dvec3 rgb = rgbFromXyz(xyzFromOpponent({filtered[0].v[i], filtered[1].v[i], filtered[2].v[i]}));
    out.lab[i] = huntLab(glm::clamp(rgb, dvec3(0), dvec3(1)));
  }
  const double sigma = 0.5 * 0.082 * ppd;  // half the width of the eye's edge detectors, 0.082 degrees
  const Kernel smooth = gaussian(sigma), first = gaussianDerivative(sigma, 1), second = gaussianDerivative(sigma, 2);
  const auto strength = [&](const Kernel& k) {
    const Plane x = convolve(luminance, k, smooth), y = convolve(luminance, smooth, k);
    std::vector<double> s(n);
    for (std::size_t i = 0; i < n; ++i) s[i] = std::hypot(x.v[i], y.v[i]);
    return s;
  };
  out.edge = strength(first);
  out.point = strength(second);
  return out;
}

}  // namespace

Result<Flip> flipDifference(const Image8& a, const Image8& b, double ppd) {
  if (a.width != b.width || a.height != b.height || a.rgba.size() != b.rgba.size() || a.rgba.empty()) {
    return Error{fmt::format("expected pictures of one size, got {}x{} and {}x{}", a.width, a.height, b.width, b.height)};
  }
  const Seen seenA = see(a, ppd), seenB = see(b, ppd);
  // The greatest distance of two colours of the display: green and blue (paper, section 4.1).
  const double greatest = std::pow(hyab(huntLab({0, 1, 0}), huntLab({0, 0, 1})), 0.7);
  Flip out{a.width, a.height, {}, 0};
  out.difference.resize(seenA.lab.size());
  for (std::size_t i = 0; i < out.difference.size(); ++i) {
    const double e = std::pow(hyab(seenA.lab[i], seenB.lab[i]), 0.7);
    // Differences under 0.4 of the greatest get 0.95 of the scale, the rest the remainder.
    const double knee = 0.4 * greatest;
    const double colour = e < knee ? 0.95 * e / knee : 0.95 + 0.05 * (e - knee) / (greatest - knee);
    const double feature = std::max(std::abs(seenA.edge[i] - seenB.edge[i]), std::abs(seenA.point[i] - seenB.point[i]));
    const double f = std::sqrt(std::clamp(feature / std::numbers::sqrt2, 0.0, 1.0));
    const double d = std::clamp(std::pow(std::min(colour, 1.0), 1 - f), 0.0, 1.0);
    out.difference[i] = float(d);
    out.mean += d;
  }
  out.mean /= double(out.difference.size());
  return out;
}

Image8 flipPicture(const Flip& flip) {
  static constexpr dvec3 kStops[] = {{0, 0, 4}, {60, 15, 110}, {150, 40, 125}, {225, 85, 95}, {252, 165, 110}, {252, 253, 191}};
  constexpr int kLast = int(std::size(kStops)) - 1;
  Image8 out{flip.width, flip.height, {}};
  out.rgba.reserve(flip.difference.size() * 4);
  for (const float d : flip.difference) {
    const double t = std::clamp(double(d), 0.0, 1.0) * kLast;
    const int i = std::min(int(t), kLast - 1);
    const dvec3 c = glm::mix(kStops[i], kStops[i + 1], t - i);
    for (int k = 0; k < 3; ++k) out.rgba.push_back(std::uint8_t(std::lround(c[k])));
    out.rgba.push_back(255);
  }
  return out;
}

}  // namespace welkin::measure
