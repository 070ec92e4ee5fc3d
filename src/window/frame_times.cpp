#include "frame_times.h"

#include <algorithm>

namespace welkin::window {

void FrameTimes::add(double frame_ms, const std::map<std::string, gpu::PassTime>& passes) {
  frame_.ms[next_] = float(frame_ms);
  for (auto& [name, row] : passes_) row.ms[next_] = 0;
  for (const auto& [name, time] : passes) passes_[name].ms[next_] = float(time.wall_ms);
  next_ = (next_ + 1) % kKept;
}

double FrameTimes::Row::median() const {
  std::vector<float> sorted = ms;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  return sorted[sorted.size() / 2];
}

double FrameTimes::Row::greatest() const { return *std::max_element(ms.begin(), ms.end()); }

}  // namespace welkin::window
