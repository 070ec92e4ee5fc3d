#pragma once
// The window from its opening to its end: input, camera, picture, interface, in this order in every frame.
#include <filesystem>
#include <string>

#include "welkin/app/options.h"

namespace welkin::window {

struct ViewOptions {
  app::CommonOptions common;
  std::filesystem::path input;  // empty: the Earth
  std::string viewName;
  std::filesystem::path shots;  // folder; empty: the working folder
  std::filesystem::path state;  // file for tests; empty: none
};

// Returns when the window was closed. Error: no window, or nothing to begin with.
Result<void> view(const ViewOptions& options);

}  // namespace welkin::window
