#pragma once
// Reading whole files and writing them so that what is on disk is always whole: write to a temporary beside it, then rename.
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "welkin/core/result.h"

namespace welkin {

// The file's bytes. Errors: not there, a folder, not readable, larger than maxBytes.
Result<std::string> readFile(const std::filesystem::path& file, std::uint64_t maxBytes = 1ull << 30);

// Replaces `file` by `bytes`, all or nothing.
Result<void> writeFile(const std::filesystem::path& file, std::string_view bytes);

// Makes the folder if needed and tries to write into it, so that long work fails before it starts.
Result<void> makeWritableFolder(const std::filesystem::path& folder);
// The same for the folder that a file will lie in; also fails if `file` is a folder.
Result<void> checkWritableFile(const std::filesystem::path& file);

// A file in the making for writers that want a path. Without commit() nothing of it stays.
class PendingFile {
 public:
  explicit PendingFile(std::filesystem::path file);
  ~PendingFile();
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;
  const std::filesystem::path& temporary() const { return temporary_; }  // same folder and extension, hidden, unique to this process
  Result<void> commit();

 private:
  std::filesystem::path file_, temporary_;
  bool committed_ = false;
};

// Text fit for one line of a message: line breaks become spaces, other bytes outside printable ASCII "?"; at most `limit` bytes.
std::string oneLine(std::string_view text, std::size_t limit = 200);

}  // namespace welkin
