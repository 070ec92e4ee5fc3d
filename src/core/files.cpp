#include "welkin/core/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace welkin {
namespace fs = std::filesystem;
namespace {

Error failed(const fs::path& file, const char* what, int code) {
  return Error{fmt::format("{}: {}: {}", file.string(), what, std::generic_category().message(code))};
}

// A name that no other process or thread uses for the same file.
fs::path temporaryFor(const fs::path& file) {
  static std::atomic<unsigned> count{0};
  const std::string name = fmt::format(".{}.{}-{}{}", file.stem().string(), ::getpid(), count++, file.extension().string());
  return file.parent_path() / name;
}

Result<void> writeAll(const fs::path& file, std::string_view bytes) {
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (fd < 0) return failed(file, "cannot be written", errno);
  int code = 0;
  while (!bytes.empty() && code == 0) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(n));
    } else if (errno != EINTR) {
      code = errno;
    }
  }
  if (::close(fd) != 0 && code == 0) code = errno;
  if (code != 0) return failed(file, "cannot be written", code);
  return {};
}

}  // namespace

Result<std::string> readFile(const fs::path& file, std::uint64_t maxBytes) {
  std::error_code ec;
  if (fs::is_directory(file, ec)) return Error{fmt::format("{}: expected a file, found a folder", file.string())};
  const int fd = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return failed(file, "cannot be read", errno);
  std::string bytes;
  const auto size = fs::file_size(file, ec);
  const Error tooLarge{fmt::format("{}: expected at most {} bytes", file.string(), maxBytes)};
  if (!ec && size > maxBytes) {
    ::close(fd);
    return tooLarge;
  }
  if (!ec) bytes.reserve(size);
  char block[1 << 16];
  while (true) {
    const ssize_t n = ::read(fd, block, sizeof block);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int code = errno;
      ::close(fd);
      return failed(file, "cannot be read", code);
    }
    if (n == 0) break;
    bytes.append(block, static_cast<std::size_t>(n));
    if (bytes.size() > maxBytes) {
      ::close(fd);
      return tooLarge;
    }
  }
  ::close(fd);
  return bytes;
}

Result<void> writeFile(const fs::path& file, std::string_view bytes) {
  PendingFile pending(file);
  if (auto written = writeAll(pending.temporary(), bytes); !written) return written;
  return pending.commit();
}

Result<void> makeWritableFolder(const fs::path& folder) {
  const fs::path where = folder.empty() ? fs::path(".") : folder;
  std::error_code ec;
  fs::create_directories(where, ec);
  if (ec && !fs::is_directory(where)) return Error{fmt::format("{}: the folder cannot be made: {}", where.string(), ec.message())};
  if (!fs::is_directory(where, ec)) return Error{fmt::format("{}: expected a folder", where.string())};
  const fs::path probe = temporaryFor(where / "probe");
  if (auto written = writeAll(probe, ""); !written) {
    return Error{fmt::format("{}: nothing can be written into this folder", where.string())};
  }
  fs::remove(probe, ec);
  return {};
}

Result<void> checkWritableFile(const fs::path& file) {
  std::error_code ec;
  if (file.filename().empty() || fs::is_directory(file, ec))
    return Error{fmt::format("{}: expected the name of a file, found a folder", file.string())};
  return makeWritableFolder(file.parent_path());
}

PendingFile::PendingFile(fs::path file) : file_(std::move(file)), temporary_(temporaryFor(file_)) {}

PendingFile::~PendingFile() {
  std::error_code ec;
  if (!committed_) fs::remove(temporary_, ec);
}

Result<void> PendingFile::commit() {
  // The bytes must be on disk before the name points at them, or a crash leaves an empty file.
  const int fd = ::open(temporary_.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return failed(file_, "was not written", errno);
  ::fsync(fd);
  ::close(fd);
  std::error_code ec;
  fs::rename(temporary_, file_, ec);
  if (ec) return Error{fmt::format("{}: cannot be written: {}", file_.string(), ec.message())};
  committed_ = true;
  return {};
}

std::string oneLine(std::string_view text, std::size_t limit) {
  std::string line;
  for (const char c : text) {
    if (line.size() >= limit) {
      line += "...";
      break;
    }
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\n' || c == '\r' || c == '\t') {
      line += ' ';
    } else {
      line += byte < 0x20 || byte >= 0x7f ? '?' : c;
    }
  }
  return line;
}

}  // namespace welkin
