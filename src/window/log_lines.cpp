#include "log_lines.h"

#include <spdlog/sinks/ringbuffer_sink.h>

#include <algorithm>

#include "welkin/core/log.h"

namespace welkin::window {
namespace {

constexpr std::size_t kKept = 200;
std::shared_ptr<spdlog::sinks::ringbuffer_sink_mt> g_lines;

}  // namespace

LogLines::LogLines() {
  g_lines = std::make_shared<spdlog::sinks::ringbuffer_sink_mt>(kKept);
  g_lines->set_pattern("%H:%M:%S %l  %v");
  sink_ = g_lines;
  spdlog::default_logger()->sinks().push_back(sink_);
}

LogLines::~LogLines() {
  auto& sinks = spdlog::default_logger()->sinks();
  sinks.erase(std::remove(sinks.begin(), sinks.end(), sink_), sinks.end());
  g_lines.reset();
}

std::vector<std::string> LogLines::last() { return g_lines ? g_lines->last_formatted() : std::vector<std::string>{}; }

}  // namespace welkin::window
