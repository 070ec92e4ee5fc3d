#pragma once
// What the errors of a sweep are from.
#include <functional>

#include "converge_trees.h"

namespace welkin::app {

struct TruthPicture {
  ImageF light;
  Image8 image;
  std::vector<std::uint32_t> pixels;  // of those alone it is true; empty: of all
  measure::ImageError tolerance;      // how far it may be from what it stands for
};

struct TruthSettings {
  TruthKind kind = TruthKind::Gpu;
  Quality quality;          // of the tree, and of the march if that is the truth
  int every = 1;            // tree, source: one pixel in every^2
  double tolerance = 1e-5;  // of a ray's weights
  ToneCurve curve{};
  double exposure_ev = 0;
};

// Of the renderer's tree as it is, or of its scene's cloud source. `progress` returns false to stop.
Result<TruthPicture> drawTruth(Renderer& renderer, const View& view, Size size, const TruthSettings& settings,
                               const std::function<bool(double)>& progress);
std::string describeTruth(const TruthSettings& settings);  // one line

// The pixels of a picture that count, as one row; all of them: the picture itself.
ImageF chosen(const ImageF& picture, const std::vector<std::uint32_t>& pixels);

}  // namespace welkin::app
