#include "welkin/app/contact_sheet.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace welkin::app {
namespace {

constexpr int kGap = 6;              // pixels between thumbnails
constexpr std::uint8_t kPaper = 24;  // dark grey

// Picture values are display values; light adds up in linear ones. A power of 2.2 is near enough to the sRGB curve for a thumbnail.
const std::array<float, 256>& linearTable() {
  static const auto table = [] {
    std::array<float, 256> t{};
    for (std::size_t i = 0; i < 256; ++i) t[i] = std::pow(float(i) / 255.0f, 2.2f);
    return t;
  }();
  return table;
}

struct Span {  // source pixels that a target pixel covers, with the weights of the first and last
  int first, last;
  float firstWeight, lastWeight;
};
Span spanOf(int target, int targets, int sources) {
  const double low = double(target) * sources / targets, high = double(target + 1) * sources / targets;
  const int first = std::min(int(low), sources - 1), last = std::clamp(int(std::ceil(high)) - 1, first, sources - 1);
  if (first == last) return {first, last, 1, 1};
  return {first, last, float(first + 1 - low), float(high - last)};
}
float weightOf(const Span& s, int i) { return i == s.first ? s.firstWeight : i == s.last ? s.lastWeight : 1.0f; }

}  // namespace

Image8 scaled(const Image8& image, int width, int height) {
  Image8 out{width, height, std::vector<std::uint8_t>(std::size_t(width) * std::size_t(height) * 4, 255)};
  const auto& linear = linearTable();
  for (int y = 0; y < height; ++y) {
    const Span rows = spanOf(y, height, image.height);
    for (int x = 0; x < width; ++x) {
      const Span columns = spanOf(x, width, image.width);
      float sum[3] = {}, weights = 0;
      for (int j = rows.first; j <= rows.last; ++j) {
        for (int i = columns.first; i <= columns.last; ++i) {
          const float w = weightOf(rows, j) * weightOf(columns, i);
          const std::uint8_t* p = &image.rgba[(std::size_t(j) * std::size_t(image.width) + std::size_t(i)) * 4];
          for (int c = 0; c < 3; ++c) sum[c] += w * linear[p[c]];
          weights += w;
        }
      }
      std::uint8_t* q = &out.rgba[(std::size_t(y) * std::size_t(width) + std::size_t(x)) * 4];
      for (int c = 0; c < 3; ++c) q[c] = std::uint8_t(std::lround(255 * std::pow(std::min(sum[c] / weights, 1.0f), 1 / 2.2f)));
    }
  }
  return out;
}

Image8 contactSheet(const std::vector<Image8>& pictures, int thumbWidth, int columns) {
  if (pictures.empty()) return {};
  const int inRow = std::min<int>(columns, int(pictures.size())), rows = (int(pictures.size()) + columns - 1) / columns;
  const int w = std::min(thumbWidth, pictures[0].width);
  const int h = std::max(1, int(std::lround(double(w) * pictures[0].height / pictures[0].width)));
  Image8 sheet{kGap + inRow * (w + kGap), kGap + rows * (h + kGap), {}};
  sheet.rgba.assign(std::size_t(sheet.width) * std::size_t(sheet.height) * 4, kPaper);
  for (std::size_t n = 0; n < pictures.size(); ++n) {
    const Image8 thumb = scaled(pictures[n], w, h);
    const int x0 = kGap + int(n) % columns * (w + kGap), y0 = kGap + int(n) / columns * (h + kGap);
    for (int y = 0; y < h; ++y) {
      const auto from = thumb.rgba.begin() + std::ptrdiff_t(y) * w * 4;
      std::copy(from, from + std::ptrdiff_t(w) * 4, sheet.rgba.begin() + (std::ptrdiff_t(y0 + y) * sheet.width + x0) * 4);
    }
  }
  for (std::size_t i = 3; i < sheet.rgba.size(); i += 4) sheet.rgba[i] = 255;
  return sheet;
}

}  // namespace welkin::app
