#pragma once
// Reads what was dropped onto the window beside the frame loop: the data of a picture may be large, and checksums take their time.
#include <chrono>
#include <deque>
#include <future>
#include <optional>

#include "welkin/app/restore.h"

namespace welkin::window {

class FileLoader {
 public:
  void begin(const std::filesystem::path& file) {
    running_.push_back(std::async(std::launch::async, [file] { return app::restoreFrom(file); }));
  }
  // The next one that was read, in the order in which they were begun.
  std::optional<Result<app::Restored>> take() {
    if (running_.empty() || running_.front().wait_for(std::chrono::seconds(0)) != std::future_status::ready) return {};
    std::optional<Result<app::Restored>> read = running_.front().get();
    running_.pop_front();
    return read;
  }

 private:
  std::deque<std::future<Result<app::Restored>>> running_;
};

}  // namespace welkin::window
