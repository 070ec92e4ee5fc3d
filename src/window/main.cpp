#include <filesystem>
#include <vector>

#include "welkin/app/cli.h"
#include "welkin/window/view_command.h"

// Without a command: the window, of the file that is named or of the Earth.
int main(int argc, char** argv) {
  std::vector<const char*> arguments(argv, argv + argc);
  std::error_code ignored;
  if (arguments.empty()) arguments.push_back("welkin");
  if (argc < 2 || std::filesystem::is_regular_file(argv[1], ignored)) arguments.insert(arguments.begin() + 1, "view");
  return welkin::app::runProgram(int(arguments.size()), arguments.data(), welkin::window::addView);
}
