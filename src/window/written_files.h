#pragma once
// Scenes and flights that the window writes; never over another file.
#include "model.h"

namespace welkin::window {

// The scene as it is now; the present view becomes its view "default".
Result<std::filesystem::path> writeScene(const Model& model, const std::filesystem::path& folder);
// What is on the tape between its in and out points, as `welkin fly` replays it.
Result<std::filesystem::path> writePath(Model& model, const std::filesystem::path& folder);
// A path whose scene the model shows: onto the tape, and played.
void loadFlight(Model& model, FlightPath path);

}  // namespace welkin::window
