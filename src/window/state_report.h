#pragma once
// What the window shows, as JSON, for tests (docs/window.md).
#include <map>
#include <string>

#include "flight_show.h"
#include "model.h"

namespace welkin::window {

struct Counts {  // since the window opened
  std::uint64_t frames = 0, pictures = 0, nanPixels = 0, holes = 0, glMessages = 0, resizes = 0;
  double seconds = 0, firstPicture_s = -1, worstFrame_ms = 0, switch_ms = 0;
  // Worst: but for the first pictures of each renderer, whose shaders are compiled then; the slowest of these: switch_ms.
  std::map<std::string, double> worst_ms;  // parts of the worst frame
};

std::string stateJson(const Model& model, const Counts& counts, const std::vector<FlightShow::Shown>& shown);

}  // namespace welkin::window
