#pragma once
// A picture of the difference that a person sees when flipping between two pictures, after Andersson et al., "FLIP: A Difference
// Evaluator for Alternating Images" (2020): contrast sensitivity, a perceptual colour distance, and edges and points.
// Written from the paper; the filters are cut off at 3 sigma and the numbers agree with the authors' program only roughly.
#include <fmt/format.h>  // before shared headers, whose macro F its templates would meet

#include <vector>

#include "welkin/core/result.h"
#include "welkin/render/renderer.h"

namespace welkin::measure {

struct Flip {
  int width = 0, height = 0;
  std::vector<float> difference;  // 0 (same) to 1, one a pixel, top row first
  double mean = 0;
};

// `pixelsPerDegree`: 67 is a 0.7 m wide 4K screen seen from 0.7 m (the paper's default). Error: sizes differ or are 0.
Result<Flip> flipDifference(const Image8& a, const Image8& b, double pixelsPerDegree = 67);

// Black, violet, orange, pale yellow: dark is alike.
Image8 flipPicture(const Flip& flip);

}  // namespace welkin::measure
