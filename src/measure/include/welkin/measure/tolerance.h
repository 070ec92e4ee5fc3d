#pragma once
// The error as the input: which march is the cheapest whose picture stays within a tolerance of the truth (docs/tolerance.md).
#include <functional>

#include "welkin/render/renderer.h"

namespace welkin::measure {

// Root mean square on 0..255 of a picture as shown, against the same tree at its greatest detail, integrated to less than 0.1 of 255.
struct MarchChoice {
  Quality quality;          // of the scene, with the step and the detail that were picked
  double estimate_255 = 0;  // error on the pixels that were tried
  double finest_255 = 0;    // error of the finest candidate there: a tolerance below it cannot be kept
  double cost = 0;          // what a ray costs, in samples (rayCost)
  int tried = 0;            // candidates drawn
  std::size_t pixels = 0;   // of the picture, in each
  bool kept = true;         // false: no candidate keeps the tolerance; the finest is picked
};

// The march that truths are made with, and the candidates: detail as a share of what the view's pixels can show, and step.
Quality truthMarch(const Quality& quality);
inline constexpr double kDetailShares[] = {1, 0.71, 0.5, 0.35, 0.25};
inline constexpr double kSteps[] = {0.04, 0.055, 0.08, 0.11, 0.16, 0.23, 0.32, 0.45, 0.64, 0.9, 1.3};
Quality candidate(const Renderer& renderer, const View& view, double detailShare, double step);

// Look-ups and samples of a ray as one number, so that a choice does not depend on the machine's mood: a look-up as 2.6 samples (marches of
// the pose near at several steps: 0.7 ms a sample and 1.8 ms a look-up a ray, 320 x 180, software GL). It orders candidates; it is no time.
double rayCost(const FrameCounters& counters);

// Needs a settled tree. Draws a regular share of the pixels (all of a small picture) with the truth and with candidates; leaves the
// renderer with the choice. `exposure_ev` at which the view is shown. Deterministic.
Result<MarchChoice> chooseMarch(Renderer& renderer, const View& view, double exposure_ev, double tolerance_255);

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
