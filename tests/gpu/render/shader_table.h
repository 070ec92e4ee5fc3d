#pragma once
// Every variant of every pass that the renderer can ask for.
#include <string>
#include <vector>

#include "welkin/gpu/program.h"

namespace welkin::test {

struct ShaderVariant {
  std::string path;
  gpu::Defines defines;
  std::string name() const {
    std::string text = path;
    for (const auto& [key, value] : defines) text += " " + key + "=" + value;
    return text;
  }
};

// Profiles and phases of an atmosphere: how many layers, which is too sharp for tables, one kind of each in turn; and how much of the
// diffuse light's series is tabulated.
inline gpu::Defines airDefines(int layers, int peak) {
  const char* degree = peak < 0 ? "2" : "4";
  const char* zonal = peak < 0 ? "2" : "12";
  gpu::Defines defines{{"AIR_LAYERS", std::to_string(layers)}, {"AIR_PEAK_LAYER", std::to_string(peak)}, {"FIELD_DEGREE", degree},
                       {"FIELD_ZONAL", zonal}, {"AIR_PEAKED", std::to_string(peak < 0 ? 0 : 1 << peak)}};
  for (int i = 0; i < 6; ++i) {
    defines.emplace_back("AIR_PROFILE_" + std::to_string(i), std::to_string(i % 3) + "u");
    defines.emplace_back("AIR_PHASE_" + std::to_string(i), std::to_string((i + peak + 4) % 4) + "u");
    defines.emplace_back("AIR_DEGREE_" + std::to_string(i), i == 2 ? "-1" : i == peak ? zonal : "2");
  }
  return defines;
}

inline constexpr const char* kToneCurveFunctions[] = {"acesFilmic", "reinhardExtended", "lottes", "uchimura"};

inline std::vector<ShaderVariant> shaderTable() {
  std::vector<ShaderVariant> table{{"pass/maps/build.comp", {}}, {"pass/reproject/reproject.comp", {}}, {"pass/debug/history.comp", {}}};
  for (const char* aux : {"0", "1"})
    for (const char* history : {"0", "1"}) table.push_back({"pass/spread/spread.comp", {{"OPT_AUX", aux}, {"OPT_HISTORY", history}}});
  for (const char* textures : {"1", "2"}) {
    for (const char* source : {"lib/clouds/layers.glsl", "lib/clouds/sphere.glsl"})
      for (const char* one : {"0", "1"})
        table.push_back({"pass/bricks/generate.comp", {{"BRICK_TEXTURES", textures}, {"SOURCE_SHADER", source}, {"ONE_LAYER", one}}});
    table.push_back({"pass/light/light.comp", {{"BRICK_TEXTURES", textures}}});
    for (const char* format : {"rg16", "rg8"}) {  // for comparisons only
      const gpu::Defines bricks{{"BRICK_TEXTURES", textures}, {"BRICK_FORMAT", format}, {"BRICK_STEPS", format[2] == '8' ? "255.0" : "65535.0"}};
      gpu::Defines generate = bricks, light = bricks;
      generate.emplace_back("SOURCE_SHADER", "lib/clouds/layers.glsl");
      light.insert(light.end(), {{"LIGHT_REACH", "3.000000"}, {"LIGHT_NEAR_SAMPLES", "6"}, {"LIGHT_NODE_SAMPLES", "4"}});
      table.push_back({"pass/bricks/generate.comp", generate});
      table.push_back({"pass/light/light.comp", light});
    }
    struct March {
      const char *air = "1", *ground = "1", *aux = "1", *history = "1";
      int pixels = 0, integrator = 5, rule = 2;
      const char* skip = "1";
    };
    const auto march = [&](const March& m) {
      table.push_back({"pass/march/march.comp",
                       {{"BRICK_TEXTURES", textures}, {"OPT_AIR", m.air}, {"OPT_GROUND", m.ground}, {"OPT_AUX", m.aux}, {"OPT_HISTORY", m.history},
                        {"INTEGRATOR", std::to_string(m.integrator)}, {"STEP_RULE", std::to_string(m.rule) + "u"}, {"SKIP_EMPTY", m.skip},
                        {"PIXELS", std::to_string(m.pixels)}}});
    };
    for (const char* air : {"0", "1"})
      for (const char* ground : {"0", "1"}) {
        for (int pixels = 0; pixels < 4; ++pixels) march({.air = air, .ground = ground, .pixels = pixels});
        march({.air = air, .ground = ground, .history = "0"});
      }
    march({.air = "0", .ground = "0", .aux = "0", .history = "0"});
    for (int view = 1; view < 7; ++view) {
      if (view == 4) continue;  // history: a pass of its own
      const auto watched = [&](const char* air, const char* ground, int integrator) {
        table.push_back({"pass/debug/clouds.comp",
                         {{"BRICK_TEXTURES", textures}, {"OPT_AIR", air}, {"OPT_GROUND", ground}, {"OPT_AUX", "1"}, {"OPT_HISTORY", "1"},
                          {"INTEGRATOR", std::to_string(integrator)}, {"STEP_RULE", "2u"}, {"SKIP_EMPTY", ground}, {"DEBUG_VIEW", std::to_string(view)}}});
      };
      watched("1", "1", 5), watched("0", "0", 6), watched("1", "1", 2);
    }
    for (int integrator = 0; integrator < 7; ++integrator) march({.integrator = integrator, .rule = integrator % 5, .skip = integrator % 2 ? "0" : "1"});
  }
  for (const auto& [layers, peak] : {std::pair{1, -1}, {3, 1}, {6, 5}}) {
    const auto sky = [&, layers = layers, peak = peak](const char* pass, gpu::Defines more = {}) {
      gpu::Defines defines = airDefines(layers, peak);
      defines.insert(defines.end(), more.begin(), more.end());
      table.push_back({std::string("pass/sky/") + pass + ".comp", defines});
    };
    for (const char* pass : {"transmittance", "sunlight", "project", "store"}) sky(pass, {{"SINGLE", "0"}, {"DIFFUSE", "0"}});
    sky("gather", {{"SINGLE", "1"}, {"DIFFUSE", "0"}, {"PIECES", "8"}});
    sky("gather", {{"SINGLE", "0"}, {"DIFFUSE", "1"}, {"PIECES", "8"}});
    sky("view_diffuse", {{"SINGLE", "0"}, {"DIFFUSE", "1"}, {"READ_DEGREE", "2"}, {"READ_ZONAL", peak < 0 ? "2" : "6"}, {"VIEW_PIECES", peak < 0 ? "1" : "3"}});
    for (const char* diffuse : {"0", "1"}) {
      sky("view", {{"SINGLE", "1"}, {"DIFFUSE", "0"}, {"VIEW_DIFFUSE", diffuse}, {"VIEW_PIECES", peak < 0 ? "1" : "3"}});
      sky("probe", {{"SINGLE", "1"}, {"DIFFUSE", diffuse}, {"PIECES", "6"}, {"STRETCHES", "16"}});
    }
  }
  for (int bits = 0; bits < 64; ++bits) {
    if ((bits & 24) == 16) continue;  // no picture of the ground without the ground: bit 4 without bit 3
    const auto on = [&](int bit) { return std::string(bits >> bit & 1 ? "1" : "0"); };
    const gpu::Defines scene{{"OPT_CLOUDS", on(0)}, {"OPT_AIR", on(1)}, {"OPT_SUN", on(2)}, {"OPT_GROUND", on(3)}, {"OPT_ALBEDO_MAP", on(4)}, {"OPT_LINEAR", on(5)}};
    const auto composite = [&](gpu::Defines more) {
      more.insert(more.begin(), scene.begin(), scene.end());
      table.push_back({"pass/composite/composite.comp", std::move(more)});
    };
    const bool linear = bits & 32;
    if (linear) composite({{"OPT_DISPLAY", "0"}});
    for (const char* curve : kToneCurveFunctions)
      if (linear || curve == kToneCurveFunctions[0]) composite({{"OPT_DISPLAY", "1"}, {"TONE_CURVE", curve}});
    if (!linear) composite({{"OPT_DISPLAY", "1"}, {"TONE_CURVE", "lottes"}, {"DEBUG_VIEW", bits & 1 ? "8" : "7"}});
  }
  table.push_back({"pass/exposure/histogram.comp", {}});
  table.push_back({"pass/exposure/adapt.comp", {}});
  for (const char* curve : kToneCurveFunctions) table.push_back({"pass/exposure/show.comp", {{"TONE_CURVE", curve}}});
  return table;
}

}  // namespace welkin::test
