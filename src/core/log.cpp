#include "welkin/core/log.h"

#include <spdlog/sinks/stdout_color_sinks.h>

namespace welkin {
void initLog(bool quiet) {
  auto logger = spdlog::get("welkin");
  if (!logger) logger = spdlog::stderr_color_mt("welkin");
  logger->set_pattern("%^%l%$ %v");
  logger->set_level(quiet ? spdlog::level::warn : spdlog::level::info);
  spdlog::set_default_logger(logger);
}
}  // namespace welkin
