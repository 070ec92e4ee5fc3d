#pragma once
// The error as the input: which march is the cheapest whose picture stays within a tolerance of the truth (docs/tolerance.md).
#include <functional>

#include "welkin/render/renderer.h"

namespace welkin::measure {

// Root mean square on 0..255 of a picture as shown, against the same tree at its greatest detail, integrated to less than 0.1 of 255.
struct MarchChoice {
  Quality quality;          // of the scene, with the step, the detail and the spread that were picked
  double estimate_255 = 0;  // error on the pixels that were tried
  double finest_255 = 0;    // error of the finest candidate there: a tolerance below it cannot be kept
  double cost = 0;          // of a pixel, in samples (marchCost)
  int tried = 0;            // candidates drawn
  std::size_t pixels = 0;   // of the picture, in each
  bool kept = true;         // false: no candidate keeps the tolerance; the finest is picked
};

// The march that truths are made with, and the candidates: detail as a share of what the view's pixels can show, step, and spread.
Quality truthMarch(const Quality& quality);
inline constexpr double kDetailShares[] = {1, 0.5, 0.25};
inline constexpr double kSteps[] = {0.04, 0.06, 0.09, 0.14, 0.22, 0.34, 0.52, 0.8, 1.3};
inline constexpr double kSpreads[] = {0, 3, 8, 20, 45, 100};
Quality candidate(const Renderer& renderer, const View& view, double detailShare, double step, double spread);

// Look-ups, samples and rays of a picture as one number a pixel, so that a choice does not depend on the machine's mood: a look-up as 1.2 samples,
// a ray as 8, all of it 1.4 times where rays are spread (least squares over 3,600 marches of the 48 views of benchmarks/error, software GL,
// 160 x 90: within 17 %). It orders candidates; it is no time.
double marchCost(const Quality& march, const FrameCounters& counters, std::size_t pixels);

// Needs a settled tree. Draws a regular share of the pixels (all of a small picture) with the truth and with candidates; leaves the
// renderer with the choice. `exposure_ev` at which the view is shown. Deterministic. Reprojected frames march single pixels: nothing is spread.
enum class DrawnAs { Whole, Reprojected };
Result<MarchChoice> chooseMarch(Renderer& renderer, const View& view, double exposure_ev, double tolerance_255, DrawnAs drawn);

// The truth's whole picture, and the error of another march's against it. The renderer keeps the march that was drawn last.
Result<ImageF> drawTruth(Renderer& renderer, const View& view);
Result<double> reachedError(Renderer& renderer, const View& view, double exposure_ev, const ImageF& truth, const Quality& march);

// chooseMarch, then reachedError; where more pixels show that it was picked too coarse, again with as much less. At most three times.
struct KeptTolerance {
  MarchChoice choice;
  double reached_255 = 0;
  int rounds = 0;
};
Result<KeptTolerance> keepTolerance(Renderer& renderer, const View& view, double exposure_ev, double tolerance_255);

}  // namespace welkin::measure
