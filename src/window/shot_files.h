#pragma once
// Names of pictures taken: by date and place, never one that is there.
#include <filesystem>
#include <string>
#include <vector>

#include "welkin/core/result.h"
#include "welkin/physics/scene.h"

namespace welkin::window {

// A file with the first of the endings; with none of the endings is there a file of this name.
Result<std::filesystem::path> newShotFile(const std::filesystem::path& folder, const View& view, double planetRadius_m,
                                          const std::vector<std::string>& endings);

}  // namespace welkin::window
