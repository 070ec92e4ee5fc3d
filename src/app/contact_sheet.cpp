#include "welkin/app/contact_sheet.h"

#include <stb_easy_font.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace welkin::app {
namespace {

constexpr int kGap = 6;                          // pixels between thumbnails
constexpr std::uint8_t kPaper = 24;              // dark grey
constexpr std::uint8_t kInk = 205;               // light grey
constexpr int kLetterScale = 2;                  // pixels of the sheet to one of the font, whose capitals are 7 high
constexpr int kCaption = 7 * kLetterScale + 10;  // height of the strip under a picture

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

void writeText(Image8& sheet, const std::string& text, int x0, int y0, int x1) {
  struct Vertex {
    float x, y, z;
    std::uint8_t colour[4];
  };
  std::vector<Vertex> corners(4 * 64 * (text.size() + 1));  // no letter of the font has 64 rectangles
  std::string letters = text;                               // the font's function wants to be able to write
  const int quads = stb_easy_font_print(0, 0, letters.data(), nullptr, corners.data(), int(corners.size() * sizeof(Vertex)));
  for (int q = 0; q < quads; ++q) {
    const Vertex& low = corners[std::size_t(q) * 4];
    const Vertex& high = corners[std::size_t(q) * 4 + 2];  // across
    const int left = x0 + int(low.x * kLetterScale), right = std::min({x0 + int(high.x * kLetterScale), x1, sheet.width});
    const int top = y0 + int(low.y * kLetterScale), bottom = std::min(y0 + int(high.y * kLetterScale), sheet.height);
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) {
        std::fill_n(sheet.rgba.begin() + (std::ptrdiff_t(y) * sheet.width + x) * 4, 3, kInk);
      }
    }
  }
}

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

Image8 contactSheet(const std::vector<SheetPicture>& pictures, int thumbWidth, int columns) {
  if (pictures.empty()) return {};
  const Image8& first = pictures[0].image;
  const int inRow = std::min<int>(columns, int(pictures.size())), rows = (int(pictures.size()) + columns - 1) / columns;
  const int w = std::min(thumbWidth, first.width);
  const int h = std::max(1, int(std::lround(double(w) * first.height / first.width)));
  Image8 sheet{kGap + inRow * (w + kGap), kGap + rows * (h + kCaption + kGap), {}};
  sheet.rgba.assign(std::size_t(sheet.width) * std::size_t(sheet.height) * 4, kPaper);
  for (std::size_t n = 0; n < pictures.size(); ++n) {
    const Image8 thumb = scaled(pictures[n].image, w, h);
    const int x0 = kGap + int(n) % columns * (w + kGap), y0 = kGap + int(n) / columns * (h + kCaption + kGap);
    for (int y = 0; y < h; ++y) {
      const auto from = thumb.rgba.begin() + std::ptrdiff_t(y) * w * 4;
      std::copy(from, from + std::ptrdiff_t(w) * 4, sheet.rgba.begin() + (std::ptrdiff_t(y0 + y) * sheet.width + x0) * 4);
    }
    writeText(sheet, pictures[n].caption, x0 + 1, y0 + h + 5, x0 + w);
  }
  for (std::size_t i = 3; i < sheet.rgba.size(); i += 4) sheet.rgba[i] = 255;
  return sheet;
}

}  // namespace welkin::app
