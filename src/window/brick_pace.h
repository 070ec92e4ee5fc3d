#pragma once
// How many bricks a frame may make, so that they take their share of its time: from what they took in the last frames.
#include <algorithm>
#include <cstdint>

namespace welkin::window {

class BrickPace {
 public:
  static constexpr double kShare_ms = 12;  // of a frame
  static constexpr std::uint32_t kFirst = 128, kLeast = 64, kMost = 8192;

  void made(std::uint32_t bricks, double ms) {
    if (bricks < kLeast / 2) return;  // too few to tell
    each_ms_ += (ms / bricks - each_ms_) / 8;
  }
  std::uint32_t perFrame() const { return std::uint32_t(std::clamp(kShare_ms / each_ms_, double(kLeast), double(kMost))); }

 private:
  double each_ms_ = kShare_ms / kFirst;
};

}  // namespace welkin::window
