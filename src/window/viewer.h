#pragma once
// The window from its first frame to its last: input, camera, picture, interface, in this order in every frame.
#include <filesystem>

#include "welkin/app/options.h"
#include "welkin/app/restore.h"
#include "welkin/app/settings.h"
#include "welkin/gpu/context.h"
#include "window.h"

namespace welkin::window {

struct ViewOptions {
  app::CommonOptions common;
  std::filesystem::path input;  // empty: the Earth
  std::string viewName;
  std::filesystem::path shots;  // folder; empty: the working folder
  std::filesystem::path state;  // file for tests; empty: none
  double begun_ms = 0;          // when the program was asked, on the clock of gpu::wall_ms
};

// Returns when the window was closed, or Ctrl-C was pressed.
void runViewer(const ViewOptions& options, app::Settings&& settings, app::Restored&& restored, Window& window, gpu::Context& context);

}  // namespace welkin::window
