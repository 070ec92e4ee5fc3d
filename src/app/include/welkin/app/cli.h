#pragma once
// The command line. Results on stdout, log and progress on stderr; 0 done, 1 failed, 2 wrong usage.
#include <functional>

#include "welkin/core/result.h"

namespace CLI {
class App;
}

namespace welkin::app {

using Action = std::function<Result<void>()>;
using AddCommand = std::function<void(CLI::App&, Action&)>;  // adds it to the parser; the action is what runs if it is chosen

// `more`: a command of a layer above.
int runProgram(int argc, const char* const* argv, const AddCommand& more = {});

}  // namespace welkin::app
