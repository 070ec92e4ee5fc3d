#pragma once
// Time of a pass. On a GPU: a pair of timestamp queries. On software GL timestamps are wrong for draws, so glFinish + clocks: wall
// time, and the process CPU clock beside it (both cores added).
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace welkin::gpu {

struct PassTime {
  double wall_ms = 0, cpu_ms = 0;
};

class PassTimer {
 public:
  explicit PassTimer(bool software) : software_(software) {}
  ~PassTimer();
  void begin(const std::string& pass);
  void end();
  // Times of all passes since the last call, by name (summed when a pass ran several times). Waits for the GPU.
  std::map<std::string, PassTime> collect();
  bool software() const { return software_; }
  bool enabled = true;  // false: no queries, no glFinish

 private:
  struct Open { std::string name; std::uint32_t query[2]; };
  bool software_;
  std::string current_;
  double wall0_ = 0, cpu0_ = 0;
  std::uint32_t query0_ = 0;
  std::map<std::string, PassTime> done_;
  std::vector<Open> pending_;
};

double processCpu_ms();  // CLOCK_PROCESS_CPUTIME_ID
double wall_ms();        // steady clock

}  // namespace welkin::gpu
