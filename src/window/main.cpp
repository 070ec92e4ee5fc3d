#include <array>

#include "welkin/app/cli.h"
#include "welkin/window/view_command.h"

int main(int argc, char** argv) {
  const std::array<const char*, 2> view{argc > 0 ? argv[0] : "welkin", "view"};
  if (argc < 2) return welkin::app::runProgram(int(view.size()), view.data(), welkin::window::addView);
  return welkin::app::runProgram(argc, argv, welkin::window::addView);
}
