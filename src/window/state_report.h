#pragma once
// What the window shows, as JSON, for tests (docs/window.md).
#include <array>
#include <map>
#include <string>

#include "flight_show.h"
#include "model.h"

namespace welkin::window {

struct Counts {  // since the window opened
  std::uint64_t frames = 0, pictures = 0, nanPixels = 0, holes = 0, glMessages = 0, resizes = 0, made = 0;  // made: renderers
  double seconds = 0, firstPicture_s = -1, worstFrame_ms = 0;  // worst: but for the very first
  std::map<std::string, double> worst_ms;  // parts of the worst frame
  std::array<std::uint64_t, 8> latency{};  // pictures shown in the frame that read their input, one later, ...
};

std::string stateJson(const Model& model, const Counts& counts, const std::vector<FlightShow::Shown>& shown);

}  // namespace welkin::window
