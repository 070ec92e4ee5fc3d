#pragma once
// Scenes and flights that the window writes; never over another file.
#include "model.h"

namespace welkin::window {

// The scene as it is now; the present view becomes its view "default".
Result<std::filesystem::path> writeScene(const Model& model, const std::filesystem::path& folder);
// The recording between its in and out points, as `welkin fly` replays it.
Result<std::filesystem::path> writePath(const Model& model, const std::filesystem::path& folder);

}  // namespace welkin::window
