// Where the data files of a picture are, now that it may have been moved.
#include <fmt/format.h>

#include "welkin/app/checksum.h"
#include "welkin/app/picture.h"
#include "welkin/app/places.h"
#include "welkin/core/files.h"
#include "welkin/physics/scene_io.h"

namespace welkin::app {
namespace fs = std::filesystem;
namespace {

std::vector<fs::path> placesOf(const fs::path& file, const fs::path& picture) {
  const fs::path folder = fs::absolute(picture).lexically_normal().parent_path(), name = file.filename();
  fs::path below;  // the way from the picture without its way up: a checkout may have moved as a whole
  for (const auto& part : file.lexically_proximate(folder)) {
    if (part != ".." && !part.is_absolute()) below /= part;
  }
  return {file, folder / name, folder / "data" / name, fs::absolute(below).lexically_normal(), programFolder() / "data" / name};
}

}  // namespace

Result<void> findData(PictureState& state, const fs::path& picture) {
  std::map<fs::path, std::string> found;
  for (const auto& [file, sum] : state.data) {
    std::error_code ec;
    if (sum == kMissing) {
      // It was drawn without the file (procedural weather, plain ground); were it read now, it would be another picture.
      if (fs::exists(file, ec))
        replaceDataFile(state.scene, file, {});
      else
        found[file] = sum;
      continue;
    }
    std::string changed;
    fs::path place;
    for (const auto& candidate : placesOf(file, picture)) {
      if (!fs::is_regular_file(candidate, ec)) continue;
      const auto now = sha256File(candidate);
      if (now && (sum.empty() || *now == sum)) {
        place = candidate;
        found[place] = *now;
        break;
      }
      if (!changed.empty()) continue;
      changed =
          now ? fmt::format("{} has changed: expected sha256 {}, got {}", candidate.string(), oneLine(sum, 64), *now) : now.error().message;
    }
    if (!place.empty()) {
      replaceDataFile(state.scene, file, place);
    } else if (!changed.empty()) {
      return Error{fmt::format("{}: welkin:data: {}", picture.string(), changed)};
    } else if (!sum.empty()) {
      return Error{fmt::format("{}: welkin:data: missing data: {} (sha256 {})", picture.string(), file.string(), oneLine(sum, 64))};
    }
  }
  state.data = std::move(found);
  return {};
}

}  // namespace welkin::app
