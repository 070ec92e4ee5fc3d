#include "panels.h"
#include "tape_bar.h"
#include "welkin/app/video.h"
#include "welkin/core/progress.h"
#include "widgets.h"

namespace welkin::window {
namespace {

void record(Model& model) {
  if (model.deck.mode() == Deck::Mode::Recording) {
    if (press("Stop recording", "R stops too, and saves")) model.wanted.endRecording = true;
    ImGui::SameLine();
    ImGui::TextColored({1, 0.45f, 0.4f, 1}, "recording, %.1f s", model.deck.at_s());
    return;
  }
  if (press("Record", "from now on, what the camera does, in place of this flight; R too")) model.deck.record();
  if (model.deck.tape.empty()) ImGui::SameLine(), ImGui::TextDisabled("or drop a path onto the window");
}

void edit(Model& model) {
  Deck& deck = model.deck;
  const double step_s = deck.tape.step_s(), whole_s = deck.tape.duration_s();
  ImGui::SameLine();
  ImGui::TextDisabled("%d frames, %.1f s", deck.tape.frames(), whole_s);
  if (tapeBar(deck)) model.show(deck.tape.at(deck.at_s()));
  ImGui::TextDisabled("at %.2f s; kept %.2f s to %.2f s", deck.at_s(), deck.in_s(), deck.out_s());
  if (deck.mode() == Deck::Mode::Playing) {
    if (press("Pause", "stays here")) deck.stop();
  } else if (press("Play", "from here to the out point, at the pace at which it was flown, as sharp as this machine can")) {
    deck.play();
  }
  ImGui::SameLine();
  tick("loop", deck.loop, "from the in point again when the out point is reached");
  ImGui::SameLine();
  if (press("Save path", "from the in to the out point, for `welkin fly`; never over another file")) model.wanted.savePath = true;
  double in_s = deck.in_s(), out_s = deck.out_s();
  const auto frame = [&](double s) { return int(std::lround(s / step_s)); };
  const Edited in = number("in point", in_s, 0, {0, whole_s, "%.2f s"}, "what is before is not played or saved");
  if (in.now) deck.tape.setIn(frame(in_s));
  const Edited out = number("out point", out_s, whole_s, {0, whole_s, "%.2f s"}, "what is after is not played or saved");
  if (out.now) deck.tape.setOut(frame(out_s));
  if (in.finished || out.finished) deck.tape.letGo();
  ImGui::BeginDisabled(deck.tape.in() == 0 && deck.tape.out() + 1 == deck.tape.frames());
  if (press("Keep only this", "throws away what lies outside of the points; it can be undone")) deck.keepBetween();
  ImGui::EndDisabled();
  const auto back = [&](const char* label, bool can, const std::string& what, void (app::Tape::*go)()) {
    ImGui::SameLine();
    ImGui::BeginDisabled(!can);
    if (press(label, can ? what.c_str() : "nothing")) (deck.tape.*go)(), deck.moveTo(deck.at_s());
    ImGui::EndDisabled();
  };
  back("Undo edit", deck.tape.canUndo(), deck.tape.undoes(), &app::Tape::undo);
  back("Redo edit", deck.tape.canRedo(), deck.tape.redoes(), &app::Tape::redo);
}

// What takes as long as it takes: each frame as `welkin fly` draws it.
void exactly(Model& model) {
  ImGui::TextDisabled("frame by frame, as `welkin fly` draws it");
  const auto ask = [&](const char* label, FlightTask task, const char* text) {
    if (press(label, text)) model.deck.stop(), model.wanted.flight = task;
  };
  ask("Replay exactly", FlightTask::Show, "the very pictures of `welkin fly`, at the path's size; it takes as long as it takes");
  ImGui::SameLine();
  ask("Benchmark", FlightTask::Measure, "measures each frame and writes the result beside the path; the window pauses meanwhile");
  ImGui::SameLine();
  static const bool ffmpeg = app::haveFfmpeg();
  ImGui::BeginDisabled(!ffmpeg);
  ask("Video", FlightTask::Film, ffmpeg ? "writes an MP4 beside the path" : "needs the program ffmpeg, which is not on the PATH");
  ImGui::EndDisabled();
}

void running(Model& model) {
  const auto& [task, progress, stopping] = *model.flight;
  ImGui::TextUnformatted(kFlightTasks[std::size_t(task)]);
  ImGui::SameLine();
  const double left_s = progress.fraction > 0 ? progress.since_s * (1 - progress.fraction) / progress.fraction : -1;
  ImGui::TextDisabled("%s, %s left", progress.note.c_str(), clockText(left_s).c_str());
  ImGui::ProgressBar(float(progress.fraction), {-ImGui::GetFontSize() * 5, 0});
  ImGui::SameLine();
  if (press(stopping ? "stopping" : "Stop", "Escape does it too; what it has written goes")) model.wanted.stopFlight = true;
}

}  // namespace

void flightPanel(Model& model) {
  if (model.flight) return running(model);
  record(model);
  if (model.deck.tape.empty() || model.deck.mode() == Deck::Mode::Recording) return;
  edit(model);
  exactly(model);
}

}  // namespace welkin::window
