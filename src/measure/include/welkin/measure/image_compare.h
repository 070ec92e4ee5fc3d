#pragma once
// How far two pictures are apart. Numbers with _255 are on the scale 0..255 of a display.
#include <fmt/format.h>  // before shared headers, whose macro F its templates would meet

#include <cstdint>

#include "welkin/core/result.h"
#include "welkin/render/renderer.h"

namespace welkin::measure {

struct ImageError {
  double rmse_255 = 0;                                     // over all pixels and the three colours
  double psnr_db = 0;                                      // 20 log10(255 / rmse_255); +inf for equal pictures
  double mean_255 = 0;                                     // mean of |difference|, all colours
  double max_255 = 0;                                      // greatest |difference| of any colour
  double p99_255 = 0;                                      // 99th percentile over pixels of a pixel's greatest |difference|
  double p999_255 = 0;                                     // 99.9th percentile of the same
  double shareOver1 = 0, shareOver2 = 0, shareOver16 = 0;  // shares of pixels whose greatest |difference| is over 1, 2, 16 of 255
  double flip = 0;                                         // mean of the perceived difference, 0..1 (flip.h); 0 if not asked
  // Linear pictures only: of the radiances themselves.
  double linearRmse = 0;        // units of the picture
  double relativeRmse = 0;      // linearRmse over the root of the mean square of the first picture
  std::uint64_t notFinite = 0;  // pixels with NaN or Inf in either picture, left out of all other numbers
};

// Error: sizes differ or are 0.
Result<ImageError> compare(const Image8& a, const Image8& b);
// Linear pictures: display numbers after exposure (stops) and the sRGB curve, clamped to 0..1.
Result<ImageError> compare(const ImageF& a, const ImageF& b, double exposure_ev = 0);

// Linear pictures as the renderer shows them, through base exposure and tone curve, before dither and rounding to 8 bits: differences far
// below 1/255 still count as what they are. `first` is the truth that relativeRmse is relative to.
Result<ImageError> compareShown(const ImageF& first, const ImageF& second, ToneCurve curve, double exposure_ev);
// The greatest |difference| of a pixel's three colours so shown, 0..255, top row first. Sizes must be equal.
std::vector<float> shownDifference(const ImageF& first, const ImageF& second, ToneCurve curve, double exposure_ev);

// Errors of one setting in several pictures of one size, as if they were one: squares and shares are averaged; p99, p999 and max are the
// greatest. Linear errors are averaged in square, each relative to its own picture.
ImageError joined(const std::vector<ImageError>& errors);

// The display values of a linear picture: exposure, clamp, sRGB curve (IEC 61966-2-1), rounded to 8 bits. No tone curve.
Image8 toDisplay(const ImageF& image, double exposure_ev);

}  // namespace welkin::measure
