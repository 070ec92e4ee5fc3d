#include <cmath>
#include <ctime>

#include "panels.h"
#include "welkin/app/geographic.h"
#include "welkin/app/sun_place.h"
#include "welkin/physics/scene_io.h"
#include "welkin/physics/scene_time.h"
#include "welkin/physics/sun_position.h"
#include "widgets.h"

namespace welkin::window {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

struct Subsolar {
  double latitude_deg, longitude_deg;
};
Subsolar subsolar(const glm::dvec3& d) {
  return {std::asin(std::clamp(d.z, -1.0, 1.0)) / kDegree, std::atan2(d.y, d.x) / kDegree};
}

void sunFields(Model& model) {
  Sun& sun = *model.scene.sun;
  const Sun& loaded = model.asLoaded.sun ? *model.asLoaded.sun : sun;
  const glm::dvec3 toSun = sunAt(sun, model.time_s), wasTo = sunAt(loaded, model.time_s);
  Subsolar at = subsolar(toSun);
  const Subsolar was = subsolar(wasTo);
  bool moved = false;
  const auto field = [&](const char* label, double& value, double before, const Range& range, const char* text) {
    const Edited e = number(label, value, before, range, text);
    moved = moved || e.now;
  };
  field("sun over latitude", at.latitude_deg, was.latitude_deg, {-90, 90, "%.1f deg"}, "where the sun stands in the zenith");
  field("sun over longitude", at.longitude_deg, was.longitude_deg, {-180, 180, "%.1f deg"}, "15 degrees are an hour");
  const GeographicView here = app::toGeographic(model.camera.view(), model.scene.planet.radius_m);
  app::SunInSky seen = app::sunInSky(toSun, here.latitude_deg, here.longitude_deg);
  const app::SunInSky before = app::sunInSky(wasTo, here.latitude_deg, here.longitude_deg);
  const bool sky =
      number("sun elevation here", seen.elevation_deg, before.elevation_deg, {-90, 90, "%.1f deg"}, "over the horizon below the camera")
          .now |
      number("sun azimuth here", seen.azimuth_deg, before.azimuth_deg, {0, 360, "%.1f deg"}, "clockwise from north").now;
  if (press("Sun as now", "where the sun stands over the Earth at this moment")) {
    const double days = double(std::time(nullptr)) / 86400 - 10957.5;  // from 1970-01-01 00:00 to 2000-01-01 12:00 UTC
    const SubsolarPoint now = subsolarPoint(days);
    at = {now.latitude_deg, now.longitude_deg}, moved = true;
  }
  if (sky) sun.direction_planet = sunStartOf(sun, app::sunDirection(seen, here.latitude_deg, here.longitude_deg), model.time_s);
  if (moved) sun.direction_planet = sunStartOf(sun, directionTo(at.latitude_deg, at.longitude_deg), model.time_s);
  if (sky || moved) model.wanted.air = true;
  double factor = sun.irradiance[1];
  const Edited bright = number("irradiance", factor, loaded.irradiance[1], {0.01, 100, "%.3g", true},
                               "of the sun at 550 nm, at the planet; the others follow");
  if (bright.now && sun.irradiance[1] > 0)
    for (double& e : sun.irradiance) e *= factor / sun.irradiance[1], factor = std::max(factor, 1e-9);
  if (bright.finished) model.wanted.air = true;
}

void airFields(Model& model) {
  Atmosphere& air = *model.scene.atmosphere;
  for (std::size_t i = 0; i < air.layers.size(); ++i) {
    AirLayer& layer = air.layers[i];
    const AirLayer& loaded =
        model.asLoaded.atmosphere && i < model.asLoaded.atmosphere->layers.size() ? model.asLoaded.atmosphere->layers[i] : layer;
    const auto amount = [](const AirLayer& l) { return l.scattering_per_m[1] + l.absorption_per_m[1]; };
    const double was = amount(layer);
    if (was <= 0) continue;
    double now = was * 1000;
    ImGui::PushID(int(i));
    const Edited e = number(layer.name.empty() ? "air" : layer.name.c_str(), now, amount(loaded) * 1000, {1e-6, 10, "%.3g /km", true},
                            "extinction at the ground, or in the middle of the layer, at 550 nm; other wavelengths follow");
    ImGui::PopID();
    if (e.now)
      for (int c = 0; c < 3; ++c) layer.scattering_per_m[c] *= now / 1000 / was, layer.absorption_per_m[c] *= now / 1000 / was;
    if (e.finished) model.wanted.air = true;
  }
}

void cloudFields(Model& model) {
  bool finished = false;
  for (std::size_t s = 0; s < model.scene.clouds->sources.size(); ++s) {
    auto* source = std::get_if<LayersSource>(&model.scene.clouds->sources[s]);
    if (!source) continue;
    line("weather", source->coverMap.empty() ? "procedural" : source->coverMap.filename().string());
    for (std::size_t i = 0; i < source->layers.size(); ++i) {
      CloudLayer& layer = source->layers[i];
      CloudLayer loaded = layer;
      if (model.asLoaded.clouds && s < model.asLoaded.clouds->sources.size())
        if (const auto* was = std::get_if<LayersSource>(&model.asLoaded.clouds->sources[s]); was && i < was->layers.size())
          loaded = was->layers[i];
      ImGui::PushID(int(s * 100 + i));
      if (ImGui::TreeNode(fmt::format("{}###layer", layer.name.empty() ? "layer" : layer.name).c_str())) {
        finished |=
            number("extinction", layer.extinction_per_m, loaded.extinction_per_m, {1e-5, 1, "%.3g /m", true}, "the greatest").finished;
        finished |= number("base", layer.base_m, loaded.base_m, {0, layer.top_m - 1, "%.0f m"}, "altitude").finished;
        finished |= number("top", layer.top_m, loaded.top_m, {layer.base_m + 1, 30'000, "%.0f m"}, "altitude").finished;
        finished |= number("cover gain", layer.coverGain, loaded.coverGain, {0, 4, "%.2f"}, "of the weather's cover").finished;
        finished |= number("cover bias", layer.coverBias, loaded.coverBias, {-1, 1, "%.2f"}, "added to the weather's cover").finished;
        finished |= number("billow", layer.billow, loaded.billow, {0, 1, "%.2f"}, "0 plain, 1 like cauliflower").finished;
        ImGui::TreePop();
      }
      ImGui::PopID();
    }
  }
  int seed = int(model.scene.quality.seed & 0x7fffffff);
  ImGui::InputInt("seed", &seed);
  explain("of the procedural weather");
  if (ImGui::IsItemDeactivatedAfterEdit() && seed >= 0) model.scene.quality.seed = unsigned(seed), finished = true;
  if (finished) model.wanted.rebuild = true;
}

}  // namespace

void scenePanel(Model& model) {
  Scene& scene = model.scene;
  line("scene", scene.name);
  line("radius", fmt::format("{:.0f} km", scene.planet.radius_m / 1000));
  if (scene.sun) sunFields(model);
  if (scene.atmosphere && ImGui::TreeNodeEx("air", ImGuiTreeNodeFlags_DefaultOpen)) {
    airFields(model);
    ImGui::TreePop();
  }
  const auto part = [&](const char* label, auto& now, const auto& loaded, const char* text) {
    bool on = now.has_value();
    if (!now && !loaded) return;
    if (!tick(label, on, text)) return;
    if (on)
      now = loaded;
    else
      now.reset();
    model.wanted.rebuild = true;
  };
  part("air##there", scene.atmosphere, model.asLoaded.atmosphere, "with or without the atmosphere");
  ImGui::SameLine();
  part("clouds##there", scene.clouds, model.asLoaded.clouds, "with or without clouds");
  ImGui::SameLine();
  part("sun##there", scene.sun, model.asLoaded.sun, "with or without the sun");
  if (scene.clouds && ImGui::TreeNode("clouds")) {
    cloudFields(model);
    ImGui::TreePop();
  }
  if (press("Save scene", "as welkin-scene.json, never over another file; the present view becomes its view \"default\""))
    model.wanted.saveScene = true;
  ImGui::SameLine();
  if (press("Undo", "Ctrl Z")) model.undo();
  ImGui::SameLine();
  if (press("Redo", "Ctrl Shift Z")) model.redo();
}

}  // namespace welkin::window
