// Scene to JSON. Numbers are written with as many digits as bring the same double back.
#include <fmt/format.h>

#include "scene_io_json.h"
#include "welkin/core/files.h"
#include "welkin/core/units.h"
#include "welkin/physics/scene_io.h"

namespace welkin {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

struct Writer {
  fs::path baseFolder;

  std::string dataFile(const fs::path& file) const {
    if (baseFolder.empty()) return file.generic_string();
    return fs::absolute(file).lexically_normal().lexically_proximate(fs::absolute(baseFolder).lexically_normal()).generic_string();
  }

  Json airLayer(const AirLayer& layer) const {
    Json out{{"name", layer.name}};
    if (const auto* e = std::get_if<ExponentialProfile>(&layer.profile))
      out["profile"] = {{"type", "exponential"}, {"scale_height_m", e->scaleHeight_m}};
    if (const auto* t = std::get_if<TentProfile>(&layer.profile)) {
      out["profile"] = {{"type", "tent"}, {"peak_m", t->peak_m}, {"half_width_m", t->halfWidth_m}};
    }
    if (const auto* u = std::get_if<UniformProfile>(&layer.profile))
      out["profile"] = {{"type", "uniform"}, {"base_m", u->base_m}, {"top_m", u->top_m}};
    out["scattering_per_m"] = layer.scattering_per_m;
    out["absorption_per_m"] = layer.absorption_per_m;
    switch (layer.phase) {
      case PhaseType::Rayleigh:
        out["phase"]["type"] = "rayleigh";
        break;
      case PhaseType::Isotropic:
        out["phase"]["type"] = "isotropic";
        break;
      case PhaseType::CornetteShanks:
        out["phase"] = {{"type", "cornette-shanks"}, {"g", layer.g}};
        break;
      case PhaseType::HenyeyGreenstein:
        out["phase"] = {{"type", "henyey-greenstein"}, {"g", layer.g}};
        break;
    }
    return out;
  }

  Json cloudLayer(const CloudLayer& l) const {
    // Names every field: one added to CloudLayer does not compile here until it is written too, and a picture's state stays whole.
    const auto& [name, base_m, top_m, baseFade_m, topFade_m, extinction_per_m, coverGain, coverBias, typeLow, typeHigh, cell_m, octaves,
                 gain, billow, softness, taper, topFollowsCover, streak, warp_m] = l;
    return {{"name", name},
            {"base_m", base_m},
            {"top_m", top_m},
            {"base_fade_m", baseFade_m},
            {"top_fade_m", topFade_m},
            {"extinction_per_m", extinction_per_m},
            {"cover_gain", coverGain},
            {"cover_bias", coverBias},
            {"type_low", typeLow},
            {"type_high", typeHigh},
            {"cell_m", cell_m},
            {"octaves", octaves},
            {"gain", gain},
            {"billow", billow},
            {"softness", softness},
            {"taper", taper},
            {"top_follows_cover", topFollowsCover},
            {"streak", streak},
            {"warp_m", warp_m}};
  }

  Json cloudSource(const CloudSource& source) const {
    Json out;
    if (const auto* sphere = std::get_if<SphereSource>(&source)) {
      out["type"] = "sphere";
      out["centre_m"] = Json::array({sphere->centre_m.x, sphere->centre_m.y, sphere->centre_m.z});
      out["radius_m"] = sphere->radius_m;
      out["extinction_per_m"] = sphere->extinction_per_m;
    } else if (const auto* slab = std::get_if<SlabSource>(&source)) {
      out = {{"type", "slab"}, {"base_m", slab->base_m}, {"top_m", slab->top_m}, {"extinction_per_m", slab->extinction_per_m}};
    } else {
      const auto& layers = std::get<LayersSource>(source);
      out["type"] = layers.coverMap.empty() ? "layers" : "cover-map";
      if (!layers.coverMap.empty()) out["file"] = dataFile(layers.coverMap);
      for (const auto& layer : layers.layers) out["layers"].push_back(cloudLayer(layer));
    }
    return out;
  }
};

}  // namespace

std::string sceneToJson(const Scene& scene, const fs::path& baseFolder, int indent) {
  [[maybe_unused]] const auto& [sceneName, file, planet, atmosphere, sun, clouds, quality, output, views] =
      scene;  // as above: none forgotten
  [[maybe_unused]] const auto& [radius_m, albedo, albedoMap] = scene.planet;
  const Writer writer{baseFolder};
  Json out;
  if (!scene.name.empty()) out["name"] = scene.name;
  out["planet"] = {{"radius_m", scene.planet.radius_m}, {"albedo", scene.planet.albedo}};
  if (!scene.planet.albedoMap.empty()) out["planet"]["albedo_map"] = writer.dataFile(scene.planet.albedoMap);
  if (scene.atmosphere) {
    out["atmosphere"] = {{"top_m", scene.atmosphere->top_m}, {"model", scene.atmosphere->model}, {"layers", Json::array()}};
    for (const auto& layer : scene.atmosphere->layers) out["atmosphere"]["layers"].push_back(writer.airLayer(layer));
  }
  if (scene.sun) {
    const auto& [irradiance, angularRadius_rad, direction, day_s] = *scene.sun;
    out["sun"]["irradiance"] = irradiance;
    out["sun"]["angular_radius_rad"] = angularRadius_rad;
    out["sun"]["direction"] = Json::array({direction.x, direction.y, direction.z});
    out["sun"]["day_s"] = day_s;
  }
  if (scene.clouds) {
    const auto& [sources, combineMax, windEast_m_per_s] = *scene.clouds;
    out["clouds"]["sources"] = Json::array();
    for (const auto& source : sources) out["clouds"]["sources"].push_back(writer.cloudSource(source));
    out["clouds"]["combine"] = combineMax ? "max" : "add";
    out["clouds"]["wind_east_m_per_s"] = windEast_m_per_s;
  }
  for (const auto& [name, view] : scene.views) out["views"][name] = detail::writeView(view);
  const auto& [budget_bytes, depth, integrator, stepRule, step, skipEmpty, spread, detail, seed] = scene.quality;
  out["quality"] = {{"budget", bytesExact(budget_bytes)},
                    {"depth", depth},
                    {"integrator", kIntegratorNames[std::size_t(integrator)]},
                    {"step_rule", kStepRuleNames[std::size_t(stepRule)]},
                    {"step", step},
                    {"skip_empty", skipEmpty},
                    {"spread", spread},
                    {"detail", detail},
                    {"seed", seed}};
  const auto& [exposure_ev, toneCurve, autoExposure] = output;
  const auto& [compensation_ev, adaptToBright_s, adaptToDark_s, lowPercentile, highPercentile, min_ev, max_ev] = autoExposure;
  if (exposure_ev)
    out["output"]["exposure_ev"] = *exposure_ev;
  else
    out["output"]["exposure_ev"] = "auto";
  out["output"]["tone_curve"] = kToneCurveNames[std::size_t(toneCurve)];
  out["output"]["auto_exposure"] = {{"compensation_ev", compensation_ev},
                                    {"adapt_to_bright_s", adaptToBright_s},
                                    {"adapt_to_dark_s", adaptToDark_s},
                                    {"low_percentile", lowPercentile},
                                    {"high_percentile", highPercentile},
                                    {"min_ev", min_ev},
                                    {"max_ev", max_ev}};
  return out.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Result<void> saveScene(const Scene& scene, const fs::path& file) {
  return writeFile(file, sceneToJson(scene, file.has_parent_path() ? file.parent_path() : fs::path(".")) + "\n");
}

}  // namespace welkin
