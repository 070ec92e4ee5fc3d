#pragma once
// Log lines go to stderr; results go to stdout.
#include <spdlog/spdlog.h>

namespace welkin {
void initLog(bool quiet);  // quiet: warnings and errors only
namespace log = spdlog;
}  // namespace welkin
