#include <fmt/format.h>
#include <lodepng.h>

#include <algorithm>

#include "welkin/app/picture.h"
#include "welkin/core/files.h"
#include "welkin/physics/path_io.h"

namespace welkin::app {
namespace fs = std::filesystem;

Result<std::string> pngBytes(const Image8& image, const Texts& texts) {
  lodepng::State state;
  state.info_raw.colortype = LCT_RGBA;
  state.info_png.color.colortype = LCT_RGB;  // the picture is opaque
  state.encoder.auto_convert = 0;
  state.encoder.text_compression = 0;  // so that any tool, and grep, can read it
  std::vector<std::uint8_t> opaque = image.rgba;
  for (std::size_t i = 3; i < opaque.size(); i += 4) opaque[i] = 255;
  for (const auto& [key, text] : texts) {
    const bool plain = std::all_of(text.begin(), text.end(), [](char c) { return c == '\n' || (c >= 0x20 && c < 0x7f); });
    const unsigned failed = plain ? lodepng_add_text(&state.info_png, key.c_str(), text.c_str())
                                  : lodepng_add_itext(&state.info_png, key.c_str(), "", key.c_str(), text.c_str());
    if (failed != 0) return Error{lodepng_error_text(failed)};
  }
  std::vector<unsigned char> bytes;
  const unsigned failed = lodepng::encode(bytes, opaque, unsigned(image.width), unsigned(image.height), state);
  if (failed != 0) return Error{lodepng_error_text(failed)};
  return std::string(bytes.begin(), bytes.end());
}

Result<void> writePng(const fs::path& file, const Image8& image, const Texts& texts) {
  const auto bytes = pngBytes(image, texts);
  if (!bytes) return Error{fmt::format("{}: {}", file.string(), bytes.error().message)};
  return writeFile(file, *bytes);
}

Result<PictureFile> readPng(const fs::path& file) {
  auto bytes = readFile(file);
  if (!bytes) return bytes.error();
  const auto* data = reinterpret_cast<const unsigned char*>(bytes->data());
  const auto bad = [&](unsigned code) {
    return Error{fmt::format("{}: expected a whole PNG picture: {}", file.string(), oneLine(lodepng_error_text(code)))};
  };
  lodepng::State state;
  unsigned width = 0, height = 0;
  // The size first: a small file can claim a picture of terabytes.
  if (const unsigned code = lodepng_inspect(&width, &height, &state, data, bytes->size()); code != 0) return bad(code);
  if (width > unsigned(kMaxPictureEdge) || height > unsigned(kMaxPictureEdge)) {
    return Error{
        fmt::format("{}: expected a picture of at most {} pixels an edge, got {}x{}", file.string(), kMaxPictureEdge, width, height)};
  }
  state.info_raw.colortype = LCT_RGBA;
  state.info_raw.bitdepth = 8;
  std::vector<unsigned char> pixels;
  if (const unsigned code = lodepng::decode(pixels, width, height, state, data, bytes->size()); code != 0) return bad(code);
  PictureFile out;
  const auto keep = [&](const char* key, const char* text) {
    if (std::string_view(key).starts_with("welkin:") || std::string_view(key).starts_with(kThesisKeys)) out.texts.emplace_back(key, text);
  };
  for (std::size_t i = 0; i < state.info_png.text_num; ++i) keep(state.info_png.text_keys[i], state.info_png.text_strings[i]);
  for (std::size_t i = 0; i < state.info_png.itext_num; ++i) keep(state.info_png.itext_keys[i], state.info_png.itext_strings[i]);
  out.pixels = Image8{int(width), int(height), std::move(pixels)};
  return out;
}

PictureKind kindOfBytes(std::string_view head) {
  if (head.starts_with("\x89PNG\r\n\x1a\n")) return PictureKind::Png;
  if (head.starts_with("\x76\x2f\x31\x01")) return PictureKind::Exr;
  return PictureKind::None;
}

PictureKind kindOfName(const fs::path& file) {
  std::string ext = file.extension().string();
  std::transform(ext.begin(), ext.end(), ext.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  return ext == ".png" ? PictureKind::Png : ext == ".exr" ? PictureKind::Exr : PictureKind::None;
}

Result<PictureFile> readPicture(const fs::path& file) {
  auto bytes = readFile(file);
  if (!bytes) return bytes.error();
  switch (kindOfBytes(*bytes)) {
    case PictureKind::Png:
      return readPng(file);
    case PictureKind::Exr:
      return readExr(file);
    case PictureKind::None:
      break;
  }
  return Error{fmt::format("{}: expected a PNG or EXR picture", file.string())};
}

}  // namespace welkin::app
