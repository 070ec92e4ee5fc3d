#include "welkin/app/build_info.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <fstream>

#include "generated/build_info.h"

namespace welkin::app {

std::string version() { return WELKIN_VERSION; }
std::string commit() { return WELKIN_COMMIT; }
std::string buildText() { return fmt::format("welkin {} ({}, {}, {})", WELKIN_VERSION, WELKIN_COMMIT, WELKIN_COMPILER, WELKIN_BUILD_TYPE); }

std::string cpuName() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const auto colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string nowUtc() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

}  // namespace welkin::app
