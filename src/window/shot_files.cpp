#include "shot_files.h"

#include <fmt/chrono.h>

#include <cmath>

#include "welkin/app/geographic.h"
#include "welkin/core/files.h"

namespace welkin::window {
namespace fs = std::filesystem;

Result<fs::path> newShotFile(const fs::path& folder, const View& view, double planetRadius_m, const std::vector<std::string>& endings) {
  if (auto writable = makeWritableFolder(folder); !writable) return writable.error();
  const GeographicView g = app::toGeographic(view, planetRadius_m);
  const double km = g.altitude_m / 1000;
  const std::string name =
      fmt::format("welkin-{:%Y-%m-%d-%H%M%S}-{:02.0f}{}-{:03.0f}{}-{}", fmt::localtime(std::time(nullptr)), std::abs(g.latitude_deg),
                  g.latitude_deg < 0 ? 'S' : 'N', std::abs(g.longitude_deg), g.longitude_deg < 0 ? 'W' : 'E',
                  km < 1 ? fmt::format("{:.0f}m", g.altitude_m) : fmt::format("{:.0f}km", km));
  for (int i = 1; i < 10000; ++i) {
    const std::string numbered = i == 1 ? name : fmt::format("{}-{}", name, i);
    bool taken = false;
    for (const auto& ending : endings) taken = taken || fs::exists(folder / (numbered + ending));
    if (!taken) return folder / (numbered + endings.front());
  }
  return Error{folder.string() + ": too many pictures of this place and second"};
}

}  // namespace welkin::window
