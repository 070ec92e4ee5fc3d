#include "render/albedo_picture.h"

#include <fmt/format.h>
#include <lodepng.h>

namespace welkin {

Result<AlbedoPicture> loadAlbedoPicture(const Scene& scene) {
  const auto file = scene.planet.albedoMap.is_absolute() ? scene.planet.albedoMap : scene.file.parent_path() / scene.planet.albedoMap;
  AlbedoPicture picture;
  unsigned width = 0, height = 0;
  if (const unsigned code = lodepng::decode(picture.rgba, width, height, file.string()))
    return Error{fmt::format("{}: expected a PNG of the ground: {}", file.string(), lodepng_error_text(code))};
  picture.width = static_cast<int>(width);
  picture.height = static_cast<int>(height);
  return picture;
}

}  // namespace welkin
