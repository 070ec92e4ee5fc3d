#pragma once
// `welkin view [SCENE | SHOT.png]`: the window (docs/window.md).
#include "welkin/app/cli.h"

namespace welkin::window {

void addView(CLI::App& app, app::Action& action);

}  // namespace welkin::window
