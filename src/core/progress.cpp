#include "welkin/core/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {
constexpr int kBarWidth = 30;
constexpr std::chrono::milliseconds kRedraw{100};  // faster than this nobody reads
}  // namespace

std::string clockText(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0 || seconds > 1e8) return "-:--";
  const auto s = std::lround(seconds);
  if (s >= 3600) return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
  return fmt::format("{}:{:02}", s / 60, s % 60);
}

Progress::Progress(std::string label, bool quiet, std::FILE* out)
    : label_(std::move(label)),
      quiet_(quiet),
      terminal_(::isatty(::fileno(out)) != 0),
      out_(out),
      start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() { finish(); }

void Progress::finish() {
  if (open_) std::fputc('\n', out_);
  open_ = false;
}

void Progress::update(double fraction, const std::string& note) {
  if (quiet_) return;
  const double f = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0.0;
  const auto now = std::chrono::steady_clock::now();
  const double spent_s = std::chrono::duration<double>(now - start_).count();
  const std::string left = f >= 1 ? "done in " + clockText(spent_s) : (f > 0 ? clockText(spent_s * (1 - f) / f) : "-:--") + " left";
  if (!terminal_) {
    const int tenths = static_cast<int>(f * 10);
    if (tenths == tenths_) return;
    tenths_ = tenths;
    fmt::print(out_, "{}: {:3.0f} %, {}{}{}\n", label_, f * 100, left, note.empty() ? "" : ", ", note);
    std::fflush(out_);
    return;
  }
  if (open_ && f < 1 && now - drawn_ < kRedraw) return;
  drawn_ = now;
  const int full = static_cast<int>(f * kBarWidth);
  fmt::print(out_, "\r\033[K{} [{:#<{}}{:.<{}}] {:3.0f} %, {}{}{}", label_, "", full, "", kBarWidth - full, f * 100, left,
             note.empty() ? "" : ", ", note);
  std::fflush(out_);
  open_ = true;
}

}  // namespace welkin
