#include <fmt/format.h>

#include <cmath>

#include "welkin/clouds/cover_map.h"
#include "welkin/clouds/default_layers.h"
#include "welkin/clouds/density_source.h"
#include "welkin/clouds/layers_source.h"
#include "welkin/clouds/sphere_source.h"

namespace welkin {
namespace {

constexpr std::uint32_t kPictureEdge = 1024;  // a quarter of the picture's 4096 columns
constexpr std::uint32_t kWeatherEdge = 512;   // made-up weather has nothing finer
// The picture is smeared along parallels beyond these latitudes: made-up weather takes its place.
constexpr double kBlendFrom_deg = 74, kBlendTo_deg = 82;

CoverMap bakePicture(const CoverPicture& picture, const ProceduralWeather& weather, std::uint32_t edge) {
  const double from = std::sin(kBlendFrom_deg * M_PI / 180), to = std::sin(kBlendTo_deg * M_PI / 180);
  const double texel_rad = 2.0 / edge;  // at a face's middle
  return CoverMap::bake(edge, [&, from, to, texel_rad](glm::dvec3 d) {
    const double t = std::clamp((std::abs(d.z) - from) / (to - from), 0.0, 1.0);
    float cover = 0;
    if (t < 1) {
      cover = picture.at(d, texel_rad);
      cover *= 2 - cover;  // the picture's brightness stays below the share of sky that is covered (mean 0.15; the Earth's is over 0.5)
    }
    if (t > 0) cover += static_cast<float>(t * t * (3 - 2 * t)) * (weather.at(d) - cover);
    return cover;
  });
}

Result<std::unique_ptr<DensitySource>> makeLayers(const LayersSource& source, const Scene& scene, const RootFrame& root) {
  const auto layers = source.layers.empty() ? defaultEarthLayers() : source.layers;
  if (layers.size() > shared::kMaxCloudLayers)
    return Error{fmt::format("{}: /clouds/sources/0/layers: {} layers; expected at most {}", scene.file.string(), layers.size(),
                             shared::kMaxCloudLayers)};
  const ProceduralWeather weather(scene.quality.seed);
  std::string note;
  std::optional<CoverMap> cover;
  if (!source.coverMap.empty()) {
    const auto file = source.coverMap.is_absolute() ? source.coverMap : scene.file.parent_path() / source.coverMap;
    std::error_code error;
    if (!std::filesystem::exists(file, error)) {
      note = fmt::format("cover map {} not found: procedural weather instead", file.string());
    } else {
      const auto picture = loadCoverPicture(file);
      if (!picture) return picture.error();
      std::uint32_t edge = kPictureEdge;
      while (edge > 16 && static_cast<int>(edge) * 4 > picture->width) edge /= 2;
      cover = bakePicture(*picture, weather, edge);
    }
  }
  if (!cover) cover = CoverMap::bake(kWeatherEdge, [&](glm::dvec3 d) { return weather.at(d); });
  return std::unique_ptr<DensitySource>(std::make_unique<LayeredClouds>(layers, std::move(cover), root, scene.quality.seed, note));
}

}  // namespace

Result<std::unique_ptr<DensitySource>> makeDensitySource(const Scene& scene, const RootFrame& root) {
  if (!scene.clouds || scene.clouds->sources.empty())
    return Error{fmt::format("{}: /clouds/sources: no cloud source", scene.file.string())};
  if (scene.clouds->sources.size() > 1)
    return Error{fmt::format("{}: /clouds/sources/1: expected one source; several (combine: {}) are not supported", scene.file.string(),
                             scene.clouds->combineMax ? "max" : "add")};
  const CloudSource& source = scene.clouds->sources.front();
  if (const auto* sphere = std::get_if<SphereSource>(&source))
    return std::unique_ptr<DensitySource>(std::make_unique<SphereCloud>(*sphere, root));
  if (const auto* slab = std::get_if<SlabSource>(&source)) return LayeredClouds::slab(*slab, root);
  return makeLayers(std::get<LayersSource>(source), scene, root);
}

}  // namespace welkin
