#pragma once
// The last frames' times, of the whole and of each pass, for plots.
#include <map>
#include <string>
#include <vector>

#include "welkin/render/renderer.h"

namespace welkin::window {

class FrameTimes {
 public:
  static constexpr std::size_t kKept = 180;
  void add(double frame_ms, const std::map<std::string, gpu::PassTime>& passes);
  struct Row {
    std::vector<float> ms = std::vector<float>(kKept, 0.0f);  // a ring
    double median() const;
    double greatest() const;
  };
  const Row& frame() const { return frame_; }
  const std::map<std::string, Row>& passes() const { return passes_; }
  int next() const { return int(next_); }  // where a ring begins

 private:
  Row frame_;
  std::map<std::string, Row> passes_;
  std::size_t next_ = 0;
};

}  // namespace welkin::window
