#include "deck.h"

#include <algorithm>

namespace welkin::window {
namespace {

constexpr double kStep_s = 1.0 / 30;
constexpr int kWarmUp = 16;  // frames, after the tree has settled: one pixel in 16 is marched in each

}  // namespace

void Deck::record() {
  recording_ = {};
  at_s_ = 0;
  mode_ = Mode::Recording;
}

Result<void> Deck::endRecording(const std::string& name, int width, int height) {
  mode_ = Mode::Idle;
  auto path = recording_.path(kStep_s);
  at_s_ = 0;
  if (!path) return path.error();
  recording_ = {};
  path->name = name;
  path->width = width, path->height = height;
  path->warmUp = kWarmUp;
  tape = app::Tape(std::move(*path));
  return {};
}

void Deck::load(FlightPath path) {
  tape = app::Tape(std::move(path));
  mode_ = Mode::Idle;
  at_s_ = 0;
}

void Deck::play() {
  if (tape.empty()) return;
  if (at_s_ < in_s() || at_s_ >= out_s()) at_s_ = in_s();
  mode_ = Mode::Playing;
}

void Deck::moveTo(double at_s) { at_s_ = std::clamp(at_s, 0.0, tape.duration_s()); }

bool Deck::add(double dt_s, const View& view, double time_s) {
  at_s_ += dt_s;
  return recording_.add(at_s_, view, time_s);
}

PathFrame Deck::advance(double dt_s) {
  at_s_ += dt_s;
  if (at_s_ >= out_s()) {
    if (loop)
      at_s_ = in_s();
    else
      at_s_ = out_s(), mode_ = Mode::Idle;
  }
  return tape.at(at_s_);
}

void Deck::keepBetween() {
  const double before_s = in_s();
  tape.keepBetween();
  moveTo(at_s_ - before_s);
}

std::filesystem::path Deck::fileOf(const std::string& scene) const {
  return tape.same(savedTape_) && scene == savedScene_ ? file_ : std::filesystem::path();
}

}  // namespace welkin::window
