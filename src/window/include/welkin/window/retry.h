#pragma once
// What fails for lack of memory is tried again once there may be some, and said to have failed once.
#include <optional>

namespace welkin::window {

constexpr double kRetry_ms = 1000;  // other programs free memory too, and nobody is told

// Of one thing that is wanted, such as a size: another one is tried at once.
template <class Goal>
class Retry {
 public:
  bool due(const Goal& goal, double now_ms) const { return failed_ != goal || now_ms >= next_ms_; }
  // The goal was tried. True: it failed, and that was not said yet.
  bool tried(const Goal& goal, bool done, double now_ms) {
    const bool known = failed_ == goal;
    next_ms_ = now_ms + kRetry_ms;
    failed_.reset();
    if (!done) failed_ = goal;
    return !done && !known;
  }

 private:
  std::optional<Goal> failed_;
  double next_ms_ = 0;
};

}  // namespace welkin::window
