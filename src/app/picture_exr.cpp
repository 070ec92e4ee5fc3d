#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "welkin/app/picture.h"
#include "welkin/core/files.h"
#include "welkin/physics/path_io.h"

namespace welkin::app {
namespace fs = std::filesystem;
namespace {
constexpr std::array<const char*, 4> kChannels{"R", "G", "B", "A"};
}

Result<void> writeExr(const fs::path& file, const ImageF& image, const Texts& texts) {
  PendingFile pending(file);
  try {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [key, text] : texts) header.insert(key, Imf::StringAttribute(text));
    // Out of half's range becomes infinity: clamp finite values to the greatest half, and let NaN and Inf be seen.
    std::vector<half> pixels(image.rgba.size());
    std::transform(image.rgba.begin(), image.rgba.end(), pixels.begin(),
                   [](float v) { return half(std::isfinite(v) ? std::clamp(v, -float(HALF_MAX), float(HALF_MAX)) : v); });
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < 4; ++c) {
      header.channels().insert(kChannels[c], Imf::Channel(Imf::HALF));
      frame.insert(kChannels[c], Imf::Slice(Imf::HALF, reinterpret_cast<char*>(pixels.data() + c), 4 * sizeof(half),
                                            4 * sizeof(half) * std::size_t(image.width)));
    }
    Imf::OutputFile out(pending.temporary().c_str(), header);
    out.setFrameBuffer(frame);
    out.writePixels(image.height);
  } catch (const std::exception& e) {
    return Error{fmt::format("{}: cannot be written: {}", file.string(), oneLine(e.what()))};
  }
  return pending.commit();
}

Result<PictureFile> readExr(const fs::path& file) {
  try {
    Imf::InputFile in(file.c_str());
    const Imf::Header& header = in.header();
    const auto window = header.dataWindow();
    const std::int64_t width = std::int64_t(window.max.x) - window.min.x + 1, height = std::int64_t(window.max.y) - window.min.y + 1;
    if (width < 1 || height < 1 || width > kMaxPictureEdge || height > kMaxPictureEdge) {
      return Error{
          fmt::format("{}: expected a picture of 1 to {} pixels an edge, got {}x{}", file.string(), kMaxPictureEdge, width, height)};
    }
    for (std::size_t c = 0; c < 3; ++c) {
      if (header.channels().findChannel(kChannels[c]) == nullptr)
        return Error{fmt::format("{}: expected the channels R, G and B", file.string())};
    }
    PictureFile out;
    ImageF image{int(width), int(height), {}};
    image.rgba.resize(std::size_t(width * height) * 4);
    const std::int64_t pixelBytes = 4 * sizeof(float), rowBytes = pixelBytes * width;
    // OpenEXR addresses pixels from the origin of its window.
    char* origin = reinterpret_cast<char*>(image.rgba.data()) - window.min.x * pixelBytes - window.min.y * rowBytes;
    Imf::FrameBuffer frame;
    for (std::size_t c = 0; c < 4; ++c) {
      frame.insert(kChannels[c], Imf::Slice(Imf::FLOAT, origin + c * sizeof(float), std::size_t(pixelBytes), std::size_t(rowBytes), 1, 1,
                                            c == 3 ? 1.0 : 0.0));
    }
    in.setFrameBuffer(frame);
    in.readPixels(window.min.y, window.max.y);
    for (auto it = header.begin(); it != header.end(); ++it) {
      const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute());
      if (text != nullptr && std::string_view(it.name()).starts_with("welkin:")) out.texts.emplace_back(it.name(), text->value());
    }
    out.pixels = std::move(image);
    return out;
  } catch (const std::exception& e) {
    return Error{fmt::format("{}: expected a whole EXR picture: {}", file.string(), oneLine(e.what()))};
  }
}

}  // namespace welkin::app
