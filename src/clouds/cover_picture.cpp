#include <fmt/format.h>
#include <lodepng.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "welkin/clouds/cover_map.h"

namespace welkin {

Result<CoverPicture> loadCoverPicture(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    return Error{fmt::format("{}: no such file; expected a PNG of the cloud cover", file.string())};
  std::vector<unsigned char> encoded;
  if (lodepng::load_file(encoded, file.string()) != 0) return Error{fmt::format("{}: cannot be read", file.string())};
  lodepng::State state;
  unsigned width = 0, height = 0;
  if (const unsigned code = lodepng_inspect(&width, &height, &state, encoded.data(), encoded.size()); code != 0)
    return Error{fmt::format("{}: not a PNG picture of cloud cover: {}", file.string(), lodepng_error_text(code))};
  if (width != 2 * height || width < 16 || width > 32768)
    return Error{fmt::format("{}: {} x {} pixels; expected an equirectangular picture twice as wide as high, 16 to 32768 wide",
                             file.string(), width, height)};
  std::vector<unsigned char> rgba;
  if (const unsigned code = lodepng::decode(rgba, width, height, encoded, LCT_RGBA, 8); code != 0)
    return Error{fmt::format("{}: broken PNG: {}", file.string(), lodepng_error_text(code))};
  // whether there is alpha is seen in the pixels: a palette may carry it too
  bool alpha = false;
  for (std::size_t i = 3; i < rgba.size() && !alpha; i += 4) alpha = rgba[i] != 255;
  CoverPicture picture{static_cast<int>(width), static_cast<int>(height), {}};
  picture.cover.resize(std::size_t{width} * height);
  for (std::size_t i = 0; i < picture.cover.size(); ++i) {
    const unsigned char* p = &rgba[4 * i];
    picture.cover[i] = alpha ? p[3] : static_cast<std::uint8_t>((p[0] + p[1] + p[2] + 1) / 3);
  }
  return picture;
}

float CoverPicture::at(glm::dvec3 d, double width_rad) const {
  const auto longitude = std::atan2(static_cast<float>(d.y), static_cast<float>(d.x));
  const auto latitude = std::asin(std::clamp(static_cast<float>(d.z), -1.0f, 1.0f));
  constexpr float kPi = std::numbers::pi_v<float>;
  const float x = (longitude / (2 * kPi) + 0.5f) * static_cast<float>(width) - 0.5f;
  const float y = (0.5f - latitude / kPi) * static_cast<float>(height) - 0.5f;
  if (width_rad <= 0) return bilinear(x, y);
  const float dy = static_cast<float>(width_rad) * 0.25f / kPi * static_cast<float>(height);
  const float dx = dy / std::max(0.02f, static_cast<float>(std::sqrt(std::max(0.0, 1 - d.z * d.z))));
  return 0.25f * (bilinear(x - dx, y - dy) + bilinear(x + dx, y - dy) + bilinear(x - dx, y + dy) + bilinear(x + dx, y + dy));
}

float CoverPicture::bilinear(float x, float yFree) const {
  const float y = std::clamp(yFree, 0.0f, static_cast<float>(height - 1));
  const float fx = std::floor(x);
  const int x0 = ((static_cast<int>(fx) % width) + width) % width, x1 = (x0 + 1) % width;
  const int y0 = static_cast<int>(y), y1 = std::min(y0 + 1, height - 1);
  const float u = x - fx, v = y - static_cast<float>(y0);
  const auto texel = [&](int i, int j) {
    return static_cast<float>(cover[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)]);
  };
  const float top = texel(x0, y0) + u * (texel(x1, y0) - texel(x0, y0));
  const float bottom = texel(x0, y1) + u * (texel(x1, y1) - texel(x0, y1));
  return (top + v * (bottom - top)) / 255;
}

}  // namespace welkin
