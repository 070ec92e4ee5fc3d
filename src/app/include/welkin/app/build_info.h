#pragma once
// What was built, and on what it runs.
#include <string>

namespace welkin::app {

std::string version();    // "0.1.0"
std::string commit();     // short hash, "-dirty" if the sources had changes, "unknown" without git
std::string buildText();  // version, commit, compiler, build type in one line
std::string cpuName();    // as the system names it, or "unknown"
std::string nowUtc();     // "2024-06-21T12:00:00Z"

}  // namespace welkin::app
