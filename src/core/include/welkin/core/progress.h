#pragma once
// A progress bar with the time left, on stderr. On a terminal it redraws one line; elsewhere it prints a line every tenth.
#include <chrono>
#include <cstdio>
#include <string>

namespace welkin {

// "1:05", "2:03:04": seconds as a person reads them. Negative or not finite: "-:--".
std::string clockText(double seconds);

class Progress {
 public:
  // `quiet`: prints nothing. `out` is stderr but for tests.
  explicit Progress(std::string label, bool quiet = false, std::FILE* out = stderr);
  ~Progress();  // ends the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void update(double fraction, const std::string& note = {});  // 0..1; values outside are clamped
  void finish();

 private:
  std::string label_;
  bool quiet_, terminal_, open_ = false;
  std::FILE* out_;
  std::chrono::steady_clock::time_point start_, drawn_;
  int tenths_ = -1;
};

}  // namespace welkin
