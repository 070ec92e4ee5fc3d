#include "panels.h"
#include "widgets.h"

namespace welkin::window {

void timePanel(Model& model) {
  if (press(model.playing ? "Pause" : "Play", "the scene's time")) model.playing = !model.playing;
  ImGui::SameLine();
  if (press("To 0 s", "the scene's time back to its beginning")) model.time_s = 0;
  number("speed", model.timeSpeed, 1, {0.01, 10'000, "x %.3g", true}, "of the scene's time");
  number("time", model.time_s, 0, {0, 86'400, "%.2f s"}, "of the scene; it is stored with pictures. Clouds do not change with it yet");
}

}  // namespace welkin::window
