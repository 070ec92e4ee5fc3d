#include "welkin/app/places.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>

#include "welkin/core/files.h"
#include "welkin/gpu/program.h"

namespace welkin::app {
namespace fs = std::filesystem;
namespace {

constexpr int kMostNames = 10'000;  // of one stem: a minute at one place

// True: made now. Error: it cannot be made.
Result<bool> makeEmpty(const fs::path& file) {
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (fd >= 0) {
    ::close(fd);
    return true;
  }
  if (errno == EEXIST) return false;
  return Error{fmt::format("{}: cannot be written: {}", file.string(), std::generic_category().message(errno))};
}

}  // namespace

fs::path programFolder() { return fs::absolute(fs::path(gpu::shaderFolder())).lexically_normal().parent_path(); }

fs::path configFolder() {
  const auto folderIn = [](const char* variable) {
    const char* value = std::getenv(variable);
    const fs::path folder = value != nullptr ? value : "";
    return folder.is_absolute() ? folder : fs::path();
  };
  if (const fs::path config = folderIn("XDG_CONFIG_HOME"); !config.empty()) return config / "welkin";
  const fs::path home = folderIn("HOME");
  return home.empty() ? home : home / ".config" / "welkin";
}

std::tm localNow() { return fmt::localtime(std::time(nullptr)); }

std::string shotName(const std::tm& when, const GeographicView& where) {
  const double h = std::max(0.0, where.altitude_m);
  const std::string height = h < 999.5 ? fmt::format("{:.0f}m", h) : fmt::format("{:.0f}km", h / 1000);
  return fmt::format("welkin-{:%Y-%m-%d-%H%M}-{:02.0f}{}-{:03.0f}{}-{}", when, std::abs(where.latitude_deg),
                     where.latitude_deg < 0 ? 'S' : 'N', std::abs(where.longitude_deg), where.longitude_deg < 0 ? 'W' : 'E', height);
}

Result<fs::path> reserveFiles(const fs::path& folder, const std::string& stem, const std::vector<std::string>& extensions) {
  if (auto writable = makeWritableFolder(folder); !writable) return writable.error();
  for (int n = 1; n <= kMostNames; ++n) {
    const fs::path name = folder / (n == 1 ? stem : fmt::format("{}-{}", stem, n));
    std::vector<fs::path> made;
    bool taken = false;
    for (const auto& extension : extensions) {
      const fs::path file = name.string() + extension;
      const auto now = makeEmpty(file);
      if (now && *now) {
        made.push_back(file);
        continue;
      }
      std::error_code ignored;
      for (const auto& other : made) fs::remove(other, ignored);
      if (!now) return now.error();
      taken = true;
      break;
    }
    if (!taken) return name;
  }
  return Error{fmt::format("{}: every name like {} is taken", folder.string(), stem)};
}

}  // namespace welkin::app
