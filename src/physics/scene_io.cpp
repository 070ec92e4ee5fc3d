#include "welkin/physics/scene_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "scene_io_json.h"
#include "welkin/core/files.h"
#include "welkin/core/units.h"
#include "welkin/physics/sun_position.h"

namespace welkin {
namespace fs = std::filesystem;
namespace {

using detail::above;
using detail::InputError;
using detail::JsonPlace;
using detail::Range;

constexpr std::uint64_t kMaxSceneBytes = 16 << 20;  // thousands of times a scene
constexpr Range kAltitude_m{0, 1e8};
constexpr Range kExtinction_per_m{0, 1000};  // 1 mm of mean free path: denser is a wall
constexpr Range kFraction{0, 1};

struct Reader {
  fs::path baseFolder;

  fs::path dataFile(const JsonPlace& place) const {
    const fs::path file = place.text();
    return (baseFolder.empty() || file.is_absolute() ? file : fs::absolute(baseFolder) / file).lexically_normal();
  }

  Planet planet(const JsonPlace& p) const {
    p.object({"radius_m", "albedo", "albedo_map"});
    Planet out;
    out.radius_m = p.numberOr("radius_m", out.radius_m, {1, 1e9});
    if (p.has("albedo")) out.albedo = p.at("albedo").spectrum(kFraction);
    if (p.has("albedo_map")) out.albedoMap = dataFile(p.at("albedo_map"));
    return out;
  }

  AirLayer airLayer(const JsonPlace& p) const {
    p.object({"name", "profile", "scattering_per_m", "absorption_per_m", "phase"});
    AirLayer out;
    if (p.has("name")) out.name = p.at("name").text(0, 200);
    const JsonPlace profile = p.at("profile");
    if (!profile.value().is_object()) profile.fail("an object");
    const auto type = profile.at("type").choice({"exponential", "tent", "uniform"});
    if (type == "exponential") {
      profile.object({"type", "scale_height_m"});
      out.profile = ExponentialProfile{profile.at("scale_height_m").number(above(0, 1e8))};
    } else if (type == "tent") {
      profile.object({"type", "peak_m", "half_width_m"});
      out.profile = TentProfile{profile.at("peak_m").number(kAltitude_m), profile.at("half_width_m").number(above(0, 1e8))};
    } else {
      profile.object({"type", "base_m", "top_m"});
      const double base_m = profile.at("base_m").number(kAltitude_m);
      out.profile = UniformProfile{base_m, profile.at("top_m").number(above(base_m, 1e8))};
    }
    if (p.has("scattering_per_m")) out.scattering_per_m = p.at("scattering_per_m").spectrum(kExtinction_per_m);
    if (p.has("absorption_per_m")) out.absorption_per_m = p.at("absorption_per_m").spectrum(kExtinction_per_m);
    if (p.has("phase")) {
      const JsonPlace phase = p.at("phase");
      if (!phase.value().is_object()) phase.fail("an object");
      const auto name = phase.at("type").choice({"rayleigh", "cornette-shanks", "henyey-greenstein", "isotropic"});
      out.phase = name == "rayleigh"          ? PhaseType::Rayleigh
                  : name == "cornette-shanks" ? PhaseType::CornetteShanks
                  : name == "isotropic"       ? PhaseType::Isotropic
                                              : PhaseType::HenyeyGreenstein;
      const bool lobed = out.phase == PhaseType::CornetteShanks || out.phase == PhaseType::HenyeyGreenstein;
      if (lobed) {
        phase.object({"type", "g"});
        out.g = phase.at("g").number({-0.999, 0.999});
      } else {
        phase.object({"type"});
      }
    }
    return out;
  }

  Atmosphere atmosphere(const JsonPlace& p) const {
    p.object({"top_m", "model", "layers"});
    Atmosphere out;
    out.top_m = p.numberOr("top_m", out.top_m, above(0, 1e8));
    if (p.has("model")) out.model = p.at("model").choice({"auto", "tables-4d", "tables-2d", "march"});
    const JsonPlace layers = p.at("layers");
    const auto n = layers.array(1, 32);
    for (std::size_t i = 0; i < n; ++i) out.layers.push_back(airLayer(layers.item(i)));
    return out;
  }

  Sun sun(const JsonPlace& p) const {
    p.object({"irradiance", "angular_radius_rad", "direction", "latitude_deg", "longitude_deg", "utc", "day_s"});
    Sun out;
    if (p.has("irradiance")) out.irradiance = p.at("irradiance").spectrum({0, 1e9});
    out.angularRadius_rad = p.numberOr("angular_radius_rad", out.angularRadius_rad, {0, 0.5});
    const bool place = p.has("latitude_deg") || p.has("longitude_deg");
    if (int(p.has("direction")) + int(place) + int(p.has("utc")) > 1)
      p.failPlain("expected only one of: direction, latitude_deg and longitude_deg, utc");
    if (p.has("direction")) out.direction_planet = p.at("direction").unitVec3();
    if (place) out.direction_planet = directionTo(p.at("latitude_deg").number({-90, 90}), p.at("longitude_deg").number({-360, 360}));
    if (p.has("utc")) {
      const auto days = daysSinceJ2000(p.at("utc").text());
      if (!days) p.at("utc").failPlain(days.error().message);
      const auto point = subsolarPoint(*days);
      out.direction_planet = directionTo(point.latitude_deg, point.longitude_deg);
      out.day_s = 86'400;
    }
    out.day_s = p.numberOr("day_s", out.day_s, {-1e12, 1e12});
    return out;
  }

  CloudLayer cloudLayer(const JsonPlace& p) const {
    p.object({"name", "base_m", "top_m", "base_fade_m", "top_fade_m", "extinction_per_m", "cover_gain", "cover_bias", "type_low",
              "type_high", "cell_m", "octaves", "gain", "billow", "softness", "taper", "top_follows_cover", "streak", "warp_m"});
    CloudLayer out;
    if (p.has("name")) out.name = p.at("name").text(0, 200);
    out.base_m = p.numberOr("base_m", out.base_m, kAltitude_m);
    if (p.has("top_m") || out.top_m <= out.base_m) out.top_m = p.at("top_m").number(above(out.base_m, 1e8));
    const double thickness_m = out.top_m - out.base_m;
    out.baseFade_m = p.numberOr("base_fade_m", std::min(out.baseFade_m, thickness_m), {0, thickness_m});
    out.topFade_m = p.numberOr("top_fade_m", std::min(out.topFade_m, thickness_m), {0, thickness_m});
    out.extinction_per_m = p.numberOr("extinction_per_m", out.extinction_per_m, kExtinction_per_m);
    out.coverGain = p.numberOr("cover_gain", out.coverGain, {-100, 100});
    out.coverBias = p.numberOr("cover_bias", out.coverBias, {-100, 100});
    out.typeLow = p.numberOr("type_low", out.typeLow, kFraction);
    out.typeHigh = p.numberOr("type_high", std::max(out.typeHigh, out.typeLow), {out.typeLow, 1});
    out.cell_m = p.numberOr("cell_m", out.cell_m, {1, 1e7});
    if (p.has("octaves")) out.octaves = int(p.at("octaves").integer(1, 16));
    out.gain = p.numberOr("gain", out.gain, {0, 1});
    out.billow = p.numberOr("billow", out.billow, kFraction);
    out.softness = p.numberOr("softness", out.softness, above(0, 10));
    out.taper = p.numberOr("taper", out.taper, {0, 10});
    out.topFollowsCover = p.numberOr("top_follows_cover", out.topFollowsCover, kFraction);
    if (p.has("streak")) out.streak = int(p.at("streak").integer(0, 8));
    out.warp_m = p.numberOr("warp_m", out.warp_m, {0, 1e6});
    return out;
  }

  CloudSource cloudSource(const JsonPlace& p) const {
    if (!p.value().is_object()) p.fail("an object");
    const auto type = p.at("type").choice({"layers", "cover-map", "sphere", "slab"});
    if (type == "sphere") {
      p.object({"type", "centre_m", "radius_m", "extinction_per_m"});
      return SphereSource{p.at("centre_m").vec3({-1e9, 1e9}), p.at("radius_m").number(above(0, 1e9)),
                          p.at("extinction_per_m").number(kExtinction_per_m)};
    }
    if (type == "slab") {
      p.object({"type", "base_m", "top_m", "extinction_per_m"});
      const double base_m = p.at("base_m").number(kAltitude_m);
      return SlabSource{base_m, p.at("top_m").number(above(base_m, 1e8)), p.at("extinction_per_m").number(kExtinction_per_m)};
    }
    LayersSource out;
    if (type == "cover-map") {
      p.object({"type", "file", "layers"});
      out.coverMap = dataFile(p.at("file"));
    } else {
      p.object({"type", "layers"});
    }
    if (p.has("layers")) {  // none given: the clouds layer puts in the Earth's
      const JsonPlace layers = p.at("layers");
      const auto n = layers.array(1, 16);
      for (std::size_t i = 0; i < n; ++i) out.layers.push_back(cloudLayer(layers.item(i)));
    }
    return out;
  }

  Clouds clouds(const JsonPlace& p) const {
    p.object({"sources", "combine", "wind_east_m_per_s"});
    Clouds out;
    const JsonPlace sources = p.at("sources");
    const auto n = sources.array(1, 16);
    for (std::size_t i = 0; i < n; ++i) out.sources.push_back(cloudSource(sources.item(i)));
    if (p.has("combine")) out.combineMax = p.at("combine").choice({"max", "add"}) == "max";
    out.windEast_m_per_s = p.numberOr("wind_east_m_per_s", out.windEast_m_per_s, {-1e5, 1e5});
    return out;
  }

  Quality quality(const JsonPlace& p) const {
    p.object({"budget", "depth", "integrator", "step_rule", "step", "skip_empty", "spread", "detail", "seed"});
    Quality out;
    if (p.has("budget")) {
      const auto budget = parseBytes(p.at("budget").text(1, 40));
      if (!budget) p.at("budget").failPlain(budget.error().message);
      if (*budget < kMinBudget_bytes || *budget > kMaxBudget_bytes) p.at("budget").fail("1MiB to 1024GiB");
      out.budget_bytes = *budget;
    }
    if (p.has("depth")) out.depth = int(p.at("depth").integer(1, 24));
    if (p.has("integrator")) out.integrator = Integrator(p.at("integrator").choice(kIntegratorNames));
    if (p.has("step_rule")) out.stepRule = StepRule(p.at("step_rule").choice(kStepRuleNames));
    if (p.has("skip_empty")) out.skipEmpty = p.at("skip_empty").boolean();
    out.step = p.numberOr("step", out.step, above(0, 1000));
    out.spread = p.numberOr("spread", out.spread, {0, 255});
    out.detail = p.numberOr("detail", out.detail, {0, 1e6});
    if (p.has("seed")) out.seed = std::uint32_t(p.at("seed").integer(0, 4294967295));
    return out;
  }

  AutoExposure autoExposure(const JsonPlace& p) const {
    p.object({"compensation_ev", "adapt_to_bright_s", "adapt_to_dark_s", "low_percentile", "high_percentile", "min_ev", "max_ev"});
    AutoExposure out;
    out.compensation_ev = p.numberOr("compensation_ev", out.compensation_ev, {-20, 20});
    out.adaptToBright_s = p.numberOr("adapt_to_bright_s", out.adaptToBright_s, {0, 1e6});
    out.adaptToDark_s = p.numberOr("adapt_to_dark_s", out.adaptToDark_s, {0, 1e6});
    out.lowPercentile = p.numberOr("low_percentile", out.lowPercentile, {0, 100});
    out.highPercentile = p.numberOr("high_percentile", std::max(out.highPercentile, out.lowPercentile), {out.lowPercentile, 100});
    out.min_ev = p.numberOr("min_ev", out.min_ev, detail::kExposureRange_ev);
    out.max_ev = p.numberOr("max_ev", std::max(out.max_ev, out.min_ev), {out.min_ev, detail::kExposureRange_ev.high});
    return out;
  }

  Output output(const JsonPlace& p) const {
    p.object({"exposure_ev", "tone_curve", "auto_exposure"});
    Output out;
    if (p.has("exposure_ev")) {
      const JsonPlace exposure = p.at("exposure_ev");
      if (exposure.value().is_string()) {
        exposure.choice({"auto"});
        out.exposure_ev.reset();
      } else {
        out.exposure_ev = exposure.number(detail::kExposureRange_ev);
      }
    }
    if (p.has("tone_curve")) {
      out.toneCurve = ToneCurve(p.at("tone_curve").choice(kToneCurveNames));
    }
    if (p.has("auto_exposure")) out.autoExposure = autoExposure(p.at("auto_exposure"));
    return out;
  }

  Scene scene(const JsonPlace& p) const {
    p.object({"$schema", "name", "planet", "atmosphere", "sun", "clouds", "views", "quality", "output"});
    Scene out;
    if (p.has("name")) out.name = p.at("name").text(0, 200);
    if (p.has("planet")) out.planet = planet(p.at("planet"));
    if (p.has("atmosphere")) out.atmosphere = atmosphere(p.at("atmosphere"));
    if (p.has("sun")) out.sun = sun(p.at("sun"));
    if (p.has("clouds")) out.clouds = clouds(p.at("clouds"));
    if (p.has("quality")) out.quality = quality(p.at("quality"));
    if (p.has("output")) out.output = output(p.at("output"));
    if (p.has("views")) {
      for (const auto& name : p.at("views").keys()) {
        if (name.empty() || name.size() > 200) p.at("views").failPlain("expected names of 1 to 200 bytes");
        out.views[name] = detail::readView(p.at("views").at(name), out.planet.radius_m);
      }
    }
    return out;
  }
};

}  // namespace

Result<Scene> parseScene(std::string_view text, const std::string& sourceName, const fs::path& baseFolder) {
  try {
    const auto value = detail::parseJson(text, sourceName);
    Scene scene = Reader{baseFolder}.scene({value, sourceName});
    return scene;
  } catch (const InputError& error) {
    return Error{error.message};
  }
}

Result<Scene> loadScene(const fs::path& file) {
  auto text = readFile(file, kMaxSceneBytes);
  if (!text) return text.error();
  auto scene = parseScene(*text, file.string(), file.has_parent_path() ? file.parent_path() : fs::path("."));
  if (scene) scene->file = file;
  return scene;
}

std::vector<fs::path> dataFiles(const Scene& scene) {
  std::vector<fs::path> out;
  const auto add = [&](const fs::path& file) {
    if (!file.empty() && std::find(out.begin(), out.end(), file) == out.end()) out.push_back(file);
  };
  add(scene.planet.albedoMap);
  if (scene.clouds) {
    for (const auto& source : scene.clouds->sources) {
      if (const auto* layers = std::get_if<LayersSource>(&source)) add(layers->coverMap);
    }
  }
  return out;
}

void replaceDataFile(Scene& scene, const fs::path& from, const fs::path& to) {
  if (scene.planet.albedoMap == from) scene.planet.albedoMap = to;
  if (!scene.clouds) return;
  for (auto& source : scene.clouds->sources) {
    auto* layers = std::get_if<LayersSource>(&source);
    if (layers && layers->coverMap == from) layers->coverMap = to;
  }
}

}  // namespace welkin
