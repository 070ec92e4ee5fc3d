#pragma once
// The command line. Results on stdout, log and progress on stderr; 0 done, 1 failed, 2 wrong usage.

namespace welkin::app {

int runProgram(int argc, const char* const* argv);

}  // namespace welkin::app
