#include "welkin/clouds/cover_map.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <thread>

#include "welkin/shared/cover.glsl.h"

namespace welkin {
namespace {

std::uint8_t* bytesOf(std::vector<std::uint32_t>& words, std::uint32_t offset) {
  return reinterpret_cast<std::uint8_t*>(words.data() + offset);  // little-endian words, as the GPU reads them
}

void forRows(std::uint32_t rows, const std::function<void(std::uint32_t)>& row) {
  const unsigned count = std::clamp(std::thread::hardware_concurrency(), 1u, 8u);
  std::vector<std::jthread> threads;
  for (unsigned t = 0; t < count; ++t)
    threads.emplace_back([=, &row] {
      for (std::uint32_t r = t; r < rows; r += count) row(r);
    });
}

}  // namespace

glm::dvec3 coverDirection(std::uint32_t face, double u, double v) {
  const int axis = static_cast<int>(face / 2);
  glm::dvec3 d;
  d[axis] = face % 2 == 0 ? 1 : -1;
  d[(axis + 1) % 3] = 2 * u - 1;
  d[(axis + 2) % 3] = 2 * v - 1;
  return d;
}

CoverMap CoverMap::bake(std::uint32_t edge, const std::function<float(glm::dvec3)>& cover) {
  CoverMap map;
  std::uint32_t words = 0;
  for (std::uint32_t e = edge; map.mips_ < shared::kCoverMips && e >= 4; e /= 2) {
    map.edge_[map.mips_] = e;
    map.offset_[map.mips_] = words;
    words += 6 * (e + 2) * shared::coverStride(e) / 4 + 1;  // one more: the last triple reads a word ahead
    ++map.mips_;
  }
  map.words_.assign(words, 0);
  std::vector<float> fine(std::size_t{6} * edge * edge);
  forRows(6 * edge, [&](std::uint32_t r) {
    const std::uint32_t face = r / edge, y = r % edge;
    for (std::uint32_t x = 0; x < edge; ++x)
      fine[std::size_t{r} * edge + x] =
          std::clamp(cover(glm::normalize(coverDirection(face, (x + 0.5) / edge, (y + 0.5) / edge))), 0.0f, 1.0f);
  });
  for (std::uint32_t mip = 0; mip < map.mips_; ++mip) {
    const std::uint32_t e = map.edge_[mip], stride = shared::coverStride(e);
    auto* bytes = bytesOf(map.words_, map.offset_[mip]);
    for (std::uint32_t face = 0; face < 6; ++face)
      for (std::uint32_t y = 0; y < e; ++y)
        for (std::uint32_t x = 0; x < e; ++x)
          bytes[(face * (e + 2) + y + 1) * stride + x + 1] =
              static_cast<std::uint8_t>(std::lround(fine[(std::size_t{face} * e + y) * e + x] * 255));
    map.fillBorders(mip);
    // next mip: means of four; texels of a face differ in area by at most 1/edge, so equal weights
    std::vector<float> coarse(fine.size() / 4);
    for (std::uint32_t r = 0; r < 6 * e / 2; ++r)
      for (std::uint32_t x = 0; x < e / 2; ++x) {
        const float* a = &fine[(std::size_t{r} * 2) * e + 2 * x];
        coarse[std::size_t{r} * (e / 2) + x] = 0.25f * (a[0] + a[1] + a[e] + a[e + 1]);
      }
    fine = std::move(coarse);
  }
  map.buildPyramid();
  return map;
}

std::uint8_t CoverMap::texel(std::uint32_t mip, std::uint32_t face, std::uint32_t x, std::uint32_t y) const {
  const std::uint32_t e = edge_[mip];
  const std::uint32_t at = (face * (e + 2) + y) * shared::coverStride(e) + x;
  return static_cast<std::uint8_t>(words_[offset_[mip] + at / 4] >> (8 * (at % 4)));
}

// The border texel beyond an edge is the neighbour's first texel along the same edge; a corner is the mean of the three faces'.
void CoverMap::fillBorders(std::uint32_t mip) {
  const std::uint32_t e = edge_[mip], stride = shared::coverStride(e);
  auto* bytes = bytesOf(words_, offset_[mip]);
  const auto neighbour = [&](std::uint32_t face, double u, double v) -> std::uint8_t {
    const glm::dvec3 d = coverDirection(face, u, v);  // just beyond the edge
    const double a[3] = {std::abs(d.x), std::abs(d.y), std::abs(d.z)};
    const auto axis = static_cast<std::uint32_t>(std::max_element(a, a + 3) - a);
    const auto sign = static_cast<std::uint32_t>(d[static_cast<int>(axis)] < 0);
    const auto index = [&](std::uint32_t k) {
      const double t = d[static_cast<int>((axis + k) % 3)] / a[axis] * 0.5 + 0.5;
      return std::min(static_cast<std::uint32_t>(std::max(t * e, 0.0)), e - 1);
    };
    return texel(mip, axis * 2 + sign, index(1) + 1, index(2) + 1);
  };
  const double beyond = 0.01 / e;
  for (std::uint32_t face = 0; face < 6; ++face) {
    const auto put = [&](std::uint32_t x, std::uint32_t y, std::uint8_t value) { bytes[(face * (e + 2) + y) * stride + x] = value; };
    for (std::uint32_t i = 0; i < e; ++i) {
      const double t = (i + 0.5) / e;
      put(0, i + 1, neighbour(face, -beyond, t));
      put(e + 1, i + 1, neighbour(face, 1 + beyond, t));
      put(i + 1, 0, neighbour(face, t, -beyond));
      put(i + 1, e + 1, neighbour(face, t, 1 + beyond));
    }
    for (std::uint32_t cy = 0; cy < 2; ++cy)
      for (std::uint32_t cx = 0; cx < 2; ++cx) {
        const std::uint32_t x = cx * (e + 1), y = cy * (e + 1), xi = cx ? e : 1, yi = cy ? e : 1;
        // own corner texel and the two border texels beside it are the corner texels of the three faces
        const int sum = texel(mip, face, xi, yi) + texel(mip, face, x, yi) + texel(mip, face, xi, y);
        put(x, y, static_cast<std::uint8_t>((sum + 1) / 3));
      }
  }
}

void CoverMap::describe(shared::CloudHeader& header) const {
  header.coverMips = mips_;
  for (std::uint32_t m = 0; m < mips_; ++m) {
    header.coverEdge[m] = edge_[m];
    header.coverOffset[m] = offset_[m];
  }
  // Texels are widest at a face's middle. A mip is taken once the weather lattice's spacing, a third of the node, is wider than 3/4 of its
  // texel there: at a face's corner, where texels are half as wide, that is still two texels a spacing.
  constexpr double kVoxelsASpacing = shared::kBrickCells / 3.0;
  const double widest_m = 2.0 * static_cast<double>(header.radius_steps) * static_cast<double>(header.step_m) / edge_[0];
  for (std::uint32_t level = 0; level <= shared::kMaxDepth; ++level) {
    std::uint32_t mip = 0;
    while (mip + 1 < mips_ && kVoxelsASpacing * static_cast<double>(header.footprint_m[level]) > 0.75 * widest_m * (2 << mip)) ++mip;
    header.coverMip[level] = mip;
  }
}

void CoverMap::buildPyramid() {
  const std::uint32_t e0 = edge_[0];
  pyramid_.clear();
  for (std::uint32_t e = e0 / 2; e >= 1; e /= 2) {
    std::vector<Cell> cells(std::size_t{6} * e * e);
    for (std::uint32_t face = 0; face < 6; ++face)
      for (std::uint32_t y = 0; y < e; ++y)
        for (std::uint32_t x = 0; x < e; ++x) {
          Cell c{255, 0};
          for (std::uint32_t k = 0; k < 4; ++k) {
            const std::uint32_t sx = 2 * x + k % 2, sy = 2 * y + k / 2;
            Cell s;
            if (pyramid_.empty())
              s.lo = s.hi = texel(0, face, sx + 1, sy + 1);
            else
              s = pyramid_.back()[(std::size_t{face} * 2 * e + sy) * 2 * e + sx];
            c.lo = std::min(c.lo, s.lo);
            c.hi = std::max(c.hi, s.hi);
          }
          cells[(std::size_t{face} * e + y) * e + x] = c;
        }
    pyramid_.push_back(std::move(cells));
  }
}

// Least and greatest of interior texels x0..x1, y0..y1 (clamped to the face) of mip 0.
CoverRange CoverMap::texels(std::uint32_t face, int x0, int y0, int x1, int y1) const {
  const int last = static_cast<int>(edge_[0]) - 1;
  x0 = std::clamp(x0, 0, last), x1 = std::clamp(x1, 0, last), y0 = std::clamp(y0, 0, last), y1 = std::clamp(y1, 0, last);
  std::uint32_t k = 0;
  while (k < pyramid_.size() && (std::max(x1 - x0, y1 - y0) >> k) > 3) ++k;
  std::uint8_t lo = 255, hi = 0;
  for (int y = y0 >> k; y <= y1 >> k; ++y)
    for (int x = x0 >> k; x <= x1 >> k; ++x) {
      Cell c;
      if (k == 0)
        c.lo = c.hi = texel(0, face, static_cast<std::uint32_t>(x) + 1, static_cast<std::uint32_t>(y) + 1);
      else
        c = pyramid_[k - 1][(std::size_t{face} * (edge_[0] >> k) + static_cast<std::uint32_t>(y)) * (edge_[0] >> k) +
                            static_cast<std::uint32_t>(x)];
      lo = std::min(lo, c.lo);
      hi = std::max(hi, c.hi);
    }
  return {static_cast<float>(lo) / 255, static_cast<float>(hi) / 255};
}

// `rect`: u0, v0, u1, v1 on the face, 0..1. A box that reaches an edge also asks the neighbour's face, but a spline near the edge
// reads the neighbour's first rows too: those are border texels here.
CoverRange CoverMap::faceRange(std::uint32_t face, glm::dvec4 rect, std::uint32_t greatestMip) const {
  const double e = edge_[0];
  const int block = 1 << greatestMip;  // texels of mip 0 below one of the greatest mip
  const auto first = [&](double t) { return (static_cast<int>(std::floor(t * e)) >> greatestMip) * block - block; };
  const auto last = [&](double t) { return ((static_cast<int>(std::floor(t * e)) >> greatestMip) + 2) * block - 1; };
  const int x0 = first(rect.x), y0 = first(rect.y), x1 = last(rect.z), y1 = last(rect.w);
  CoverRange range = texels(face, x0, y0, x1, y1);
  const int n = static_cast<int>(edge_[0]);
  if (x0 >= 0 && y0 >= 0 && x1 < n && y1 < n) {
    if (greatestMip > 0 || std::max(x1 - x0, y1 - y0) > 6) return range;
    // Within a few texels: cover at the middle, and no further off than its slope allows. Between two rows of texels the slope of
    // the spline, per texel, is at most the greatest difference of neighbours.
    float dx = 0, dy = 0;
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const auto at = [&](int i, int j) {
          return static_cast<float>(texel(0, face, static_cast<std::uint32_t>(i) + 1, static_cast<std::uint32_t>(j) + 1));
        };
        if (x < x1) dx = std::max(dx, std::abs(at(x + 1, y) - at(x, y)));
        if (y < y1) dy = std::max(dy, std::abs(at(x, y + 1) - at(x, y)));
      }
    shared::CloudBlock block0{};
    block0.header.coverEdge[0] = edge_[0];
    block0.header.coverOffset[0] = offset_[0];
    const shared::CoverPlace middle{face, 0.5 * (rect.x + rect.z), 0.5 * (rect.y + rect.w)};
    const float value = shared::coverAt({&block0, words_.data()}, middle, 0);
    const auto reach =
        static_cast<float>((rect.z - rect.x) * 0.5 * e) * dx / 255 + static_cast<float>((rect.w - rect.y) * 0.5 * e) * dy / 255 + 1e-5f;
    return {std::max(range.lo, value - reach), std::min(range.hi, value + reach)};
  }
  // The neighbours' texels along the border: read from mip borders of every mip in use.
  for (std::uint32_t mip = 0; mip <= greatestMip; ++mip) {
    const int m = static_cast<int>(edge_[mip]);
    const auto join = [&](int x, int y) {
      const float v = static_cast<float>(texel(mip, face, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))) / 255;
      range.lo = std::min(range.lo, v);
      range.hi = std::max(range.hi, v);
    };
    const int ax = std::clamp((x0 >> mip), -1, m) + 1, bx = std::clamp((x1 >> mip) + 1, -1, m) + 1;
    const int ay = std::clamp((y0 >> mip), -1, m) + 1, by = std::clamp((y1 >> mip) + 1, -1, m) + 1;
    for (int x = ax; x <= bx; ++x) {
      if (y0 < 0) join(x, 0);
      if (y1 >= n) join(x, m + 1);
    }
    for (int y = ay; y <= by; ++y) {
      if (x0 < 0) join(0, y);
      if (x1 >= n) join(m + 1, y);
    }
  }
  return range;
}

CoverRange CoverMap::range(glm::uvec3 low, std::uint64_t size, std::uint32_t greatestMip) const {
  // Steps from the root's centre. The far side counts in: a brick's last samples lie on it.
  double lo[3], hi[3];
  for (int i = 0; i < 3; ++i) {
    lo[i] = static_cast<double>(low[i]) - 0x1p31;
    hi[i] = lo[i] + static_cast<double>(size);
  }
  CoverRange range{1, 0};
  for (std::uint32_t face = 0; face < 6; ++face) {
    const int axis = static_cast<int>(face / 2);
    const bool negative = face % 2 == 1;
    const double near0 = negative ? -hi[axis] : lo[axis], far0 = negative ? -lo[axis] : hi[axis];
    if (far0 < 0) continue;
    const double near = std::max(near0, 1.0), far = std::max(far0, 1.0);
    double t[2][2];
    bool meets = true;
    for (int k = 0; k < 2; ++k) {
      const int other = (axis + 1 + k) % 3;
      t[k][0] = std::min(lo[other] / near, lo[other] / far);
      t[k][1] = std::max(hi[other] / near, hi[other] / far);
      meets = meets && t[k][0] <= 1 && t[k][1] >= -1;
      for (double& v : t[k]) v = std::clamp(v, -1.0, 1.0) * 0.5 + 0.5;
    }
    if (!meets) continue;
    const CoverRange r = faceRange(face, {t[0][0], t[1][0], t[0][1], t[1][1]}, greatestMip);
    range.lo = std::min(range.lo, r.lo);
    range.hi = std::max(range.hi, r.hi);
  }
  if (range.hi <= 0) return {0, 0};  // every texel is zero, on all mips
  // mips store means of the exact cover, rounded on their own: half a step of 8 bits either way; else rounding of the spline
  const float slack = greatestMip > 0 ? 0.002f : 1e-6f;
  return {std::max(0.0f, range.lo - slack), std::min(1.0f, range.hi + slack)};
}

}  // namespace welkin
