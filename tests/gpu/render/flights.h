#pragma once
// Small flights through the small Earth, and how pictures are compared.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include "gl_fixture.h"
#include "small_earth.h"
#include "welkin/render/renderer.h"

namespace welkin::test {

// Broken cloud of many sizes, lit by the sun from the south-west (looked for once with the default seed).
inline constexpr double kLatitude_deg = 45, kLongitude_deg = 0;

// Detail limited to what settles in about a second of software GL.
inline Scene quickEarth(double detail = 8) {
  Scene scene = smallEarth();
  scene.quality.detail = detail;
  return scene;
}

inline std::unique_ptr<Renderer> makeRenderer(gpu::Context& context, const Scene& scene,
                                              RenderSettings settings = {.width = 128, .height = 72}) {
  settings.timing = false;
  auto made = Renderer::create(context, scene, settings);
  EXPECT_TRUE(made.ok()) << made.error().message;
  return made.ok() ? std::move(*made) : nullptr;
}

// From 9 km, sideways (the view looks north) east by `step_m` a frame, sinking by a tenth of it.
inline View sideways(int frame, double step_m) {
  const double east_deg = frame * step_m / (kEarthRadius_m * std::cos(kLatitude_deg * M_PI / 180)) * 180 / M_PI;
  return viewAt(kLatitude_deg, kLongitude_deg + east_deg, 9000 - 0.1 * step_m * frame, 0, -12);
}

struct PixelError {
  double rmse = 0;        // 0..1
  double shareOver1 = 0;  // of pixels whose greatest difference is over 1 of 255
  int max_255 = 0;
};
inline PixelError pixelError(const Image8& a, const Image8& b) {
  PixelError e;
  double sum = 0, over = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    int worst = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const int d = std::abs(int(a.rgba[i + c]) - int(b.rgba[i + c]));
      sum += double(d) * d;
      worst = std::max(worst, d);
    }
    over += worst > 1;
    e.max_255 = std::max(e.max_255, worst);
  }
  const double pixels = double(a.rgba.size()) / 4;
  e.rmse = std::sqrt(sum / (3 * pixels)) / 255;
  e.shareOver1 = over / pixels;
  return e;
}

// A picture that shows nothing passes many a comparison: this one has light and dark.
inline double contrast(const Image8& image) {
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    const double g = image.rgba[i + 1] / 255.0;
    sum += g, squares += g * g;
  }
  const double n = double(image.rgba.size()) / 4;
  return std::sqrt(std::max(squares / n - sum / n * (sum / n), 0.0));
}

}  // namespace welkin::test
