#pragma once
// How much smaller than the window pictures are drawn, so that a frame stays within its time: chosen from the times of the last frames.
#include <array>
#include <cstddef>

#include "welkin/app/options.h"

namespace welkin::window {

constexpr std::array<double, 5> kScales{0.25, 0.35, 0.5, 0.71, 1};  // each twice the pixels of the one before
constexpr double kMostFrame_ms = 42;  // 20 frames a second are 50 ms; the rest is for what comes between frames
constexpr double kMostRest_ms = 90;   // while nobody moves: the picture gets sharper, and no frame holds a hand up for over 100 ms

class RenderScale {
 public:
  double scale() const { return kScales[step_]; }
  // Of a window with so many pixels; at least 16 x 16, none if minimised.
  app::Size sizeFor(app::Size window) const;
  // One drawn at this scale took so long. At rest (nobody moves, and the tree has what this size shows) it may take longer; the first
  // frame that moves goes back to the scale before.
  void frame(double ms, bool rest = false);
  bool automatic = true;
  void set(double scale);  // the nearest of them, and no longer automatic

 private:
  std::size_t moving_ = 0;  // step_ before the rest
  bool rest_ = false;
  std::size_t step_ = 0;  // the first picture is the quickest
  std::array<double, 8> last_ms_{};
  std::size_t frames_ = 0;  // at this scale
  std::size_t tries_ = 0, otherTries_ = 0;   // to go up that did not hold: each next one waits longer
};

}  // namespace welkin::window
