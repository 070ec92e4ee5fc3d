#include "welkin/window/render_scale.h"

#include <algorithm>
#include <cmath>

namespace welkin::window {
namespace {

constexpr double kRise = 1.6;  // twice the pixels cost less than twice: part of a frame does not depend on them
constexpr std::size_t kPatience = 24, kMostTries = 6;

}  // namespace

app::Size RenderScale::sizeFor(app::Size window) const {
  if (window.width <= 0 || window.height <= 0) return {0, 0};
  const auto edge = [this](int pixels) { return std::max(int(std::lround(pixels * scale())), 16); };
  return {edge(window.width), edge(window.height)};
}

void RenderScale::frame(double ms, bool rest) {
  if (automatic && rest != rest_) {
    rest_ = rest, frames_ = 0;
    std::swap(tries_, otherTries_);  // what failed while a tree was made says nothing of a rest
    if (rest)
      moving_ = step_;
    else if (moving_ != step_) {
      step_ = moving_;
      return;
    }
  }
  const double most_ms = rest_ ? kMostRest_ms : kMostFrame_ms;
  last_ms_[frames_++ % last_ms_.size()] = ms;
  if (!automatic || frames_ < last_ms_.size()) return;
  auto sorted = last_ms_;
  std::sort(sorted.begin(), sorted.end());
  const double median = sorted[sorted.size() / 2];
  if (median > most_ms && step_ > 0) {
    --step_, frames_ = 0;
    tries_ = std::min(tries_ + 1, kMostTries);
  } else if (median * kRise < most_ms && step_ + 1 < kScales.size() && frames_ >= kPatience << tries_) {
    ++step_, frames_ = 0;
  }
}

void RenderScale::set(double wanted) {
  automatic = false;
  const auto nearer = [wanted](double a, double b) { return std::abs(a - wanted) < std::abs(b - wanted); };
  step_ = std::size_t(std::min_element(kScales.begin(), kScales.end(), nearer) - kScales.begin());
  frames_ = 0;
}

}  // namespace welkin::window
