#include "welkin/reference/cloud_picture.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "welkin/reference/parallel.h"

namespace welkin::reference {
namespace {
constexpr std::size_t kTogether = 16;  // neighbours in the list are one piece of work: they read the same bricks
}

std::vector<std::uint32_t> somePixels(int width, int height, int n) {
  std::vector<std::uint32_t> pixels;
  for (int row = 0; row * n < height; ++row)
    for (int column = 0; column * n < width; ++column) {
      const int x = column * n + (row * 3 + column) % n, y = row * n + (column * 5 + row) % n;
      if (x < width && y < height) pixels.push_back(std::uint32_t(y) * std::uint32_t(width) + std::uint32_t(x));
    }
  return pixels;
}

namespace {

std::vector<std::uint32_t> pixelsOf(const PictureSettings& settings) {
  if (!settings.pixels.empty()) return settings.pixels;
  std::vector<std::uint32_t> all(std::size_t(settings.width) * std::size_t(settings.height));
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

}  // namespace

CloudPicture pictureOf(const PictureSettings& settings, std::vector<CloudTruth> clouds) {
  CloudPicture picture{pixelsOf(settings), std::move(clouds)};
  for (const CloudTruth& cloud : picture.clouds) {
    picture.worstError = std::max(picture.worstError, cloud.error);
    picture.converged = picture.converged && cloud.converged;
  }
  return picture;
}

CloudPicture marchPicture(const CloudField& field, const shared::CameraBlock& camera, const PictureSettings& settings,
                          const std::function<bool(double)>& progress) {
  const std::vector<std::uint32_t> pixels = pixelsOf(settings);
  std::vector<CloudTruth> clouds(pixels.size());
  std::atomic<bool> stopped{false};
  const std::size_t works = (pixels.size() + kTogether - 1) / kTogether;
  forEach(
      works, settings.threads,
      [&](std::size_t work) {
        for (std::size_t i = work * kTogether; i < std::min((work + 1) * kTogether, pixels.size()) && !stopped; ++i) {
          const int x = int(pixels[i] % std::uint32_t(settings.width)), y = int(pixels[i] / std::uint32_t(settings.width));
          clouds[i] = marchClouds(field, pixelRay(camera, settings.width, settings.height, x, y), settings.tolerance);
        }
      },
      [&](std::size_t done) {
        if (progress && !progress(double(done) / double(works))) stopped = true;
      });
  return stopped ? CloudPicture{} : pictureOf(settings, std::move(clouds));
}

std::vector<shared::CloudWeights> weightsOf(const CloudPicture& picture, int width, int height) {
  const shared::CloudWeights none{0, 0, 0, 1, shared::kSkyDistance_m};
  std::vector<shared::CloudWeights> all(std::size_t(width) * std::size_t(height), none);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) all[picture.pixels[i]] = rounded(picture.clouds[i]);
  return all;
}

}  // namespace welkin::reference
