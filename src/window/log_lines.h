#pragma once
// The log's last lines, for the window; they still go to stderr too.
#include <memory>
#include <string>
#include <vector>

namespace spdlog::sinks {
class sink;
}

namespace welkin::window {

class LogLines {
 public:
  LogLines();
  ~LogLines();
  static std::vector<std::string> last();  // oldest first

 private:
  std::shared_ptr<spdlog::sinks::sink> sink_;
};

}  // namespace welkin::window
