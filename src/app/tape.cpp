#include "welkin/app/tape.h"

#include <cmath>

#include "welkin/app/recorder.h"

namespace welkin::app {
namespace {

constexpr double kStep_s = 1.0 / 30;  // of a path whose step is 0: it has to be shown somehow

FlightPath withoutFrames(FlightPath path) {
  path.frames.clear();
  return path;
}

}  // namespace

Tape::State Tape::whole(std::vector<PathFrame> frames) {
  const int last = std::max(int(frames.size()) - 1, 0);
  return {std::make_shared<const std::vector<PathFrame>>(std::move(frames)), 0, last};
}

Tape::Tape(FlightPath path) : head_(withoutFrames(path)), history_(whole(std::move(path.frames))) {}

double Tape::step_s() const { return head_.timeStep_s > 0 ? head_.timeStep_s : kStep_s; }

PathFrame Tape::at(double time_s) const {
  const double frame = std::clamp(time_s / step_s(), 0.0, double(frames() - 1));
  const double nearest = std::round(frame);
  if (!(std::abs(frame - nearest) > 1e-6)) return all()[std::size_t(nearest)];  // 1e-6: rounding of time_s, of up to 1e6 frames
  const PathFrame &a = all()[std::size_t(frame)], &b = all()[std::size_t(frame) + 1];
  const double part = frame - std::floor(frame);
  return {viewBetween(a.view, b.view, part), std::lerp(a.time_s, b.time_s, part)};
}

void Tape::setIn(int frame) {
  State s = history_.current();
  s.in = std::clamp(frame, 0, s.out);
  if (s.in != in()) history_.push(std::move(s), "in point");
}

void Tape::setOut(int frame) {
  State s = history_.current();
  s.out = std::clamp(frame, s.in, std::max(frames() - 1, 0));
  if (s.out != out()) history_.push(std::move(s), "out point");
}

void Tape::keepBetween() {
  if (in() == 0 && out() + 1 >= frames()) return;
  history_.push(whole(path().frames), "cut");
  history_.settle();
}

bool Tape::same(const Tape &other) const {
  const State &a = history_.current(), &b = other.history_.current();
  return a.frames == b.frames && a.in == b.in && a.out == b.out;
}

FlightPath Tape::path() const {
  FlightPath path = head_;
  if (!empty()) path.frames.assign(all().begin() + in(), all().begin() + out() + 1);
  return path;
}

}  // namespace welkin::app
