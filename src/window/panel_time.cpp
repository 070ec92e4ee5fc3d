#include <algorithm>
#include <cmath>

#include "panels.h"
#include "widgets.h"

namespace welkin::window {

void timePanel(Model& model) {
  if (press(model.playing ? "Pause" : "Play", "the scene's time")) model.playing = !model.playing;
  ImGui::SameLine();
  if (press("To 0 s", "the scene's time back to its beginning")) model.time_s = 0;
  number("speed", model.timeSpeed, 1, {0.01, 10'000, "x %.5g", true}, "of the scene's time");
  const double day_s = model.scene.sun ? std::abs(model.scene.sun->day_s) : 0;
  number("time", model.time_s, 0, {0, std::max(day_s, 86'400.0), "%.2f s"},
         "of the scene: the sun goes with the day, clouds with the wind; it is stored with pictures");
  Scene& scene = model.scene;
  if (scene.sun) {
    const Sun& loaded = model.asLoaded.sun ? *model.asLoaded.sun : *scene.sun;
    double day_h = scene.sun->day_s / 3600;
    if (number("day", day_h, loaded.day_s / 3600, {-1000, 1000, "%.2f h"},
               "from noon to noon; below 0: the sun rises in the west; 0: it stands still")
            .now)
      scene.sun->day_s = 3600 * day_h, model.wanted.air = true;
  }
  if (scene.clouds) {
    const Clouds& loaded = model.asLoaded.clouds ? *model.asLoaded.clouds : *scene.clouds;
    if (number("wind", scene.clouds->windEast_m_per_s, loaded.windEast_m_per_s, {-200, 200, "%.1f m/s"},
               "the mean one, eastwards at the equator: all clouds turn about the axis as one")
            .now)
      model.wanted.air = true;
    if (scene.sun) line("light of clouds", fmt::format("{:.2f} deg behind the sun", model.stats.lightStale_deg));
  }
}

}  // namespace welkin::window
