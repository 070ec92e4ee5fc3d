#include "panels.h"
#include "widgets.h"

namespace welkin::window {
namespace {

void tape(Model& model) {
  using Tape = Model::Tape;
  ImGui::TextDisabled("flight");
  if (model.tape == Tape::Recording) {
    ImGui::SameLine();
    ImGui::Text("recording, %.1f s", model.recording.duration_s());
    if (press("Stop", "R stops too, and saves")) model.tape = Tape::Idle;
    return;
  }
  if (press("Record", "from now on, every frame; R too")) model.recording = {}, model.tape_s = 0, model.tape = Tape::Recording;
  if (model.recording.empty()) return;
  const double whole_s = model.recording.duration_s();
  ImGui::SameLine();
  if (press(model.tape == Tape::Replaying ? "Stop replay" : "Replay", "from the in to the out point, at the pace it was flown"))
    model.tape = model.tape == Tape::Replaying ? Tape::Idle : Tape::Replaying, model.tape_s = 0;
  ImGui::SameLine();
  if (press("Save flight", "a path that `welkin fly` replays; never over another file")) model.wanted.savePath = true;
  double in_s = model.recording.in_s(), out_s = model.recording.out_s();
  const bool moved = number("in point", in_s, 0, {0, whole_s, "%.2f s"}, "what is before is not replayed or saved").now |
                     number("out point", out_s, whole_s, {0, whole_s, "%.2f s"}, "what is after is not replayed or saved").now;
  if (moved) model.recording.setCut(in_s, out_s);
}

}  // namespace

void timePanel(Model& model) {
  if (press(model.playing ? "Pause" : "Play", "the scene's time")) model.playing = !model.playing;
  ImGui::SameLine();
  if (press("To 0 s", "the scene's time back to its beginning")) model.time_s = 0;
  number("speed", model.timeSpeed, 1, {0.01, 10'000, "x %.3g", true}, "of the scene's time");
  number("time", model.time_s, 0, {0, 86'400, "%.2f s"}, "of the scene; it is stored with pictures. Clouds do not change with it yet");
  tape(model);
}

}  // namespace welkin::window
