// Scene files: what they mean, and that everything wrong is told in one line with its place.
#include "welkin/physics/scene_io.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>

#include "scene_io_support.h"
#include "welkin/core/files.h"

namespace welkin {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;
using testing_support::expectOneLine;
using testing_support::kFullScene;

Scene mustParse(const std::string& text) {
  auto scene = parseScene(text, "test.json");
  EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().message);
  return scene.ok() ? *scene : Scene{};
}

// The full scene with one place replaced.
std::string with(const std::string& pointer, const json& value) {
  json scene = json::parse(kFullScene);
  scene[json::json_pointer(pointer)] = value;
  return scene.dump();
}

std::string errorOf(const std::string& text) {
  auto scene = parseScene(text, "test.json");
  EXPECT_FALSE(scene.ok()) << "accepted: " << text.substr(0, 200);
  if (scene.ok()) return "";
  expectOneLine(scene.error().message);
  return scene.error().message;
}

TEST(SceneIo, readsEveryKey) {
  const Scene s = mustParse(kFullScene);
  EXPECT_EQ(s.name, "everything");
  EXPECT_EQ(s.planet.radius_m, 6360000);
  EXPECT_EQ(s.planet.albedo, (Spectrum3{0.1, 0.2, 0.3}));
  EXPECT_EQ(s.planet.albedoMap, "../data/earth.png");
  ASSERT_TRUE(s.atmosphere && s.sun && s.clouds);
  EXPECT_EQ(s.atmosphere->model, "march");
  ASSERT_EQ(s.atmosphere->layers.size(), 4u);
  EXPECT_EQ(std::get<ExponentialProfile>(s.atmosphere->layers[0].profile).scaleHeight_m, 8000);
  EXPECT_EQ(std::get<UniformProfile>(s.atmosphere->layers[1].profile).top_m, 2000);
  EXPECT_EQ(s.atmosphere->layers[1].g, 0.7);
  EXPECT_EQ(s.atmosphere->layers[2].phase, PhaseType::CornetteShanks);
  EXPECT_EQ(std::get<TentProfile>(s.atmosphere->layers[3].profile).halfWidth_m, 15000);
  EXPECT_EQ(s.sun->direction_planet, glm::dvec3(0.6, 0.0, 0.8));
  ASSERT_EQ(s.clouds->sources.size(), 4u);
  EXPECT_FALSE(s.clouds->combineMax);
  const auto& layer = std::get<LayersSource>(s.clouds->sources[0]).layers.at(0);
  EXPECT_EQ(layer.octaves, 7);
  EXPECT_EQ(layer.topFollowsCover, 0.5);
  EXPECT_EQ(layer.coverBias, -0.1);
  EXPECT_EQ(layer.streak, 2);
  EXPECT_EQ(layer.warp_m, 4000);
  EXPECT_TRUE(std::get<LayersSource>(s.clouds->sources[1]).layers.empty());
  EXPECT_EQ(std::get<SphereSource>(s.clouds->sources[2]).radius_m, 500);
  EXPECT_EQ(std::get<SlabSource>(s.clouds->sources[3]).top_m, 1500);
  EXPECT_EQ(s.quality.budget_bytes, 128ull << 20);
  EXPECT_EQ(s.quality.depth, 12);
  EXPECT_EQ(s.quality.seed, 7u);
  EXPECT_EQ(s.output.exposure_ev, 1.5);
  EXPECT_EQ(s.output.toneCurve, ToneCurve::Lottes);
  EXPECT_EQ(s.output.autoExposure.adaptToDark_s, 2);
  EXPECT_EQ(s.views.at("ground").exposure_ev, 3);
  EXPECT_EQ(s.views.at("space").position_m.x, 14e6);
}

TEST(SceneIo, exposureIsANumberOrMetered) {
  EXPECT_EQ(mustParse("{}").output.exposure_ev, 0) << "as it has always been";
  EXPECT_EQ(mustParse("{}").output.toneCurve, ToneCurve::Aces);
  const Scene metered = mustParse(R"({"output": {"exposure_ev": "auto", "auto_exposure": {"low_percentile": 97, "min_ev": 20}}})");
  EXPECT_FALSE(metered.output.exposure_ev);
  EXPECT_EQ(metered.output.autoExposure.highPercentile, 97) << "never below the low one";
  EXPECT_EQ(metered.output.autoExposure.min_ev, 20);
  EXPECT_FALSE(mustParse(sceneToJson(metered)).output.exposure_ev);
}

TEST(SceneIo, absentSectionsAreAbsent) {
  const Scene s = mustParse("{}");
  EXPECT_FALSE(s.atmosphere || s.sun || s.clouds);
  EXPECT_TRUE(s.views.empty());
}

TEST(SceneIo, writingAndReadingIsExact) {
  const Scene first = mustParse(kFullScene);
  const std::string text = sceneToJson(first);
  const Scene second = mustParse(text);
  EXPECT_EQ(text, sceneToJson(second));
  const View &a = first.views.at("ground"), &b = second.views.at("ground");
  EXPECT_EQ(a.position_m, b.position_m);  // to the last bit: a picture's state must not drift
  EXPECT_EQ(a.orientation, b.orientation);
}

TEST(SceneIo, writtenStateNeverDrifts) {
  // Many directions and orientations, seed 1: normalising what is already unit length would move last bits.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-90, 90);
  for (int i = 0; i < 200; ++i) {
    Scene s;
    s.sun.emplace();
    s.sun->direction_planet = directionTo(angle(random), 2 * angle(random));
    s.views["v"] = toView({angle(random), 2 * angle(random), 1000, 4 * angle(random), angle(random), 4 * angle(random), 50, {}}, 6371000);
    const Scene back = mustParse(sceneToJson(s));
    EXPECT_EQ(back.sun->direction_planet, s.sun->direction_planet);
    EXPECT_EQ(back.views.at("v").orientation, s.views.at("v").orientation);
  }
}

TEST(SceneIo, dataPathsStartAtTheScene) {
  const auto folder = std::filesystem::temp_directory_path() / "welkin_scene_io_test";
  std::filesystem::create_directories(folder / "scenes");
  ASSERT_TRUE(writeFile(folder / "scenes" / "a.json", kFullScene).ok());
  auto scene = loadScene(folder / "scenes" / "a.json");
  ASSERT_TRUE(scene.ok());
  EXPECT_EQ(scene->planet.albedoMap, folder / "data" / "earth.png");
  EXPECT_EQ(dataFiles(*scene), (std::vector<std::filesystem::path>{folder / "data" / "earth.png", folder / "data" / "clouds.png"}));
  // Saved elsewhere, the paths are rewritten to lead to the same files.
  ASSERT_TRUE(saveScene(*scene, folder / "b.json").ok());
  auto again = loadScene(folder / "b.json");
  ASSERT_TRUE(again.ok());
  EXPECT_EQ(dataFiles(*again), dataFiles(*scene));
  EXPECT_THAT(*readFile(folder / "b.json"), HasSubstr("\"data/clouds.png\""));
  std::filesystem::remove_all(folder);
}

TEST(SceneIo, geographicViews) {
  const double R = 6371000;
  // Over longitude 0 on the equator, zenith is +X, north +Z, east +Y.
  View v = toView({0, 0, 10, 90, 0, 0, 58, {}}, R);
  EXPECT_EQ(v.position_m, glm::dvec3(R + 10, 0, 0));
  const auto near = [](glm::dvec3 a, glm::dvec3 b) { return glm::length(a - b) < 1e-15 * 8; };  // a few roundings of unit vectors
  EXPECT_TRUE(near(v.orientation * glm::dvec3(0, 0, -1), {0, 1, 0}));                           // heading 90 looks east
  EXPECT_TRUE(near(v.orientation * glm::dvec3(0, 1, 0), {1, 0, 0}));                            // up is the zenith
  v = toView({0, 0, 10, 0, -90, 0, 58, {}}, R);
  EXPECT_TRUE(near(v.orientation * glm::dvec3(0, 0, -1), {-1, 0, 0}));  // straight down
  EXPECT_TRUE(near(v.orientation * glm::dvec3(0, 1, 0), {0, 0, 1}));    // north is up in the picture
  v = toView({0, 0, 10, 0, 0, 90, 58, {}}, R);
  EXPECT_TRUE(near(v.orientation * glm::dvec3(0, 1, 0), {0, 1, 0}));  // rolled right, looking north: up points east
  v = toView({90, 0, 10, 0, 0, 0, 58, {}}, R);
  EXPECT_EQ(v.position_m, glm::dvec3(0, 0, R + 10));
  EXPECT_TRUE(near(v.orientation * glm::dvec3(0, 0, -1), {-1, 0, 0}));  // on along the meridian, over the pole
}

TEST(SceneIo, sunInThreeForms) {
  EXPECT_EQ(mustParse(R"({"sun": {"direction": [0, 0, 2]}})").sun->direction_planet, glm::dvec3(0, 0, 1));
  EXPECT_EQ(mustParse(R"({"sun": {"latitude_deg": 0, "longitude_deg": 90}})").sun->direction_planet, glm::dvec3(0, 1, 0));
  const auto utc = mustParse(R"({"sun": {"utc": "2024-06-20T20:51:00Z"}})").sun->direction_planet;
  EXPECT_NEAR(glm::degrees(std::asin(utc.z)), 23.44, 0.01);  // June solstice; the formula's own accuracy
  EXPECT_THAT(errorOf(R"({"sun": {"direction": [1, 0, 0], "utc": "2024-06-20T20:51:00Z"}})"), HasSubstr("/sun: expected only one of"));
  EXPECT_THAT(errorOf(R"({"sun": {"latitude_deg": 3}})"), HasSubstr("\"longitude_deg\""));
  EXPECT_THAT(errorOf(R"({"sun": {"utc": "yesterday"}})"), HasSubstr("/sun/utc: expected a time in UTC"));
  EXPECT_THAT(errorOf(R"({"sun": {"direction": [0, 0, 0]}})"), HasSubstr("not zero"));
}

TEST(SceneIo, wrongValuesAreToldWithTheirPlace) {
  const auto says = [](const std::string& pointer, const json& value, const std::string& expected) {
    const std::string message = errorOf(with(pointer, value));
    EXPECT_THAT(message, StartsWith("test.json: " + pointer + ": "));
    EXPECT_THAT(message, HasSubstr(expected)) << message;
  };
  says("/planet/radius_m", -5, "got -5");
  says("/planet/radius_m", "big", "a number from 1 to");
  says("/planet/radius_m", nullptr, "got null");
  says("/planet/albedo", json::array({1, 1}), "a list of 3");
  says("/planet/albedo/1", 1.5, "from 0 to 1");
  says("/atmosphere/layers", json::array(), "a list of 1 to 32");
  says("/atmosphere/layers/0/profile/type", "linear", "one of: exponential, tent, uniform");
  says("/atmosphere/layers/0/profile/scale_height_m", 0, "over 0");
  says("/atmosphere/layers/1/profile/top_m", 0, "over 0");
  says("/atmosphere/layers/1/phase/g", 1, "to 0.999");
  says("/atmosphere/model", "best", "one of: auto, tables-4d");
  says("/clouds/sources/0/type", "vdb", "one of: layers, cover-map, sphere, slab");
  says("/clouds/sources/0/layers/0/octaves", 7.5, "a whole number from 1 to 16");
  says("/clouds/sources/0/layers/0/octaves", 18446744073709551615ull, "a whole number");
  says("/clouds/sources/0/layers/0/top_m", 800, "over 900");
  says("/clouds/sources/2/centre_m/0", "x", "a number");
  says("/clouds/combine", true, "one of: max, add");
  says("/views/ground/latitude_deg", 91, "from -90 to 90");
  says("/views/ground/altitude_m", -1, "from 0");
  says("/views/ground/fov_deg", 180, "to 179.9");
  says("/views/space/orientation_xyzw", json::array({1, 1, 1, 1}), "a unit quaternion");
  says("/views/space/position_m", json::array({6e6, 0, 0}), "above the ground");
  says("/quality/budget", "lots", "512MiB");
  says("/quality/budget", "1KiB", "1MiB to 1024GiB");
  says("/quality/budget", 536870912, "a text");
  says("/quality/depth", 25, "from 1 to 24");
  says("/quality/seed", -1, "from 0");
  says("/output/exposure_ev", json::array(), "a number");
  says("/output/exposure_ev", "bright", "one of: auto");
  says("/output/tone_curve", "filmic", "one of: aces, reinhard, lottes, uchimura");
  says("/output/auto_exposure/high_percentile", 10, "from 20 to 100");
  says("/output/auto_exposure/max_ev", -5, "from -3 to 40");
  says("/output/auto_exposure/adapt_to_dark_s", -1, "from 0");
}

TEST(SceneIo, unknownRepeatedAndMissingKeys) {
  EXPECT_EQ(errorOf(R"({"planet": {"radius": 5}})"),
            "test.json: /planet/radius: unknown key, expected one of: radius_m, albedo, albedo_map");
  EXPECT_THAT(errorOf(R"({"a/b~c": 5})"), HasSubstr("/a~1b~0c: unknown key"));
  EXPECT_EQ(errorOf(R"({"planet": {"radius_m": 5, "radius_m": 6}})"), "test.json: /planet/radius_m: this key is given twice");
  EXPECT_THAT(errorOf(R"({"clouds": {"sources": [{"type": "slab", "base_m": 1, "top_m": 2}]}})"),
              HasSubstr("/clouds/sources/0: expected the key \"extinction_per_m\", it is missing"));
  EXPECT_THAT(errorOf("[]"), HasSubstr("the whole file: expected an object"));
}

TEST(SceneIo, syntaxErrorsHaveLineAndColumn) {
  EXPECT_THAT(errorOf("{\n  \"planet\": {,}\n}"), StartsWith("test.json: line 2, column 14: expected JSON"));
  EXPECT_THAT(errorOf(""), StartsWith("test.json: line 1, column 1"));
  EXPECT_THAT(errorOf("{\"planet\": {\"radius_m\": NaN}}"), StartsWith("test.json: line 1, column 2"));
  EXPECT_EQ(errorOf("{\"planet\": {\"radius_m\": 1e400}}"),
            "test.json: /planet/radius_m: expected a number that a double holds, got 1e400");
  EXPECT_THAT(errorOf("{\"name\": \"\x01\"}"), StartsWith("test.json: line 1"));
  EXPECT_THAT(errorOf(std::string(100000, '[')), HasSubstr("levels of nesting"));
}

TEST(SceneIo, missingFilesAndFolders) {
  EXPECT_THAT(loadScene("/nowhere/scene.json").error().message, StartsWith("/nowhere/scene.json: cannot be read: No such file"));
  EXPECT_THAT(loadScene("/").error().message, HasSubstr("found a folder"));
}

TEST(SceneIo, truncatedAnywhereIsOneLine) {
  const std::size_t lastBrace = kFullScene.rfind('}');
  for (std::size_t n = 0; n <= lastBrace; ++n) errorOf(kFullScene.substr(0, n));
}

TEST(SceneIo, anyFlippedByteIsASceneOrOneLine) {
  for (std::size_t i = 0; i < kFullScene.size(); ++i) {
    for (const int mask : {0x01, 0x02, 0x10, 0x20, 0x80, 0xff}) {
      std::string text = kFullScene;
      text[i] = static_cast<char>(text[i] ^ mask);
      auto scene = parseScene(text, "test.json");
      if (!scene.ok()) {
        expectOneLine(scene.error().message);
      } else {
        EXPECT_TRUE(parseScene(sceneToJson(*scene), "test.json").ok())
            << "byte " << i << " mask " << mask;  // what is accepted can be written
      }
    }
  }
}

TEST(SceneIo, viewAlone) {
  const View v = toView({10, 20, 500, 30, -5, 2, 58, 1.25}, 6371000);
  Planet planet;
  auto back = parseView(viewToJson(v), "shot.png", planet);
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back->position_m, v.position_m);
  EXPECT_EQ(back->orientation, v.orientation);
  EXPECT_EQ(back->exposure_ev, v.exposure_ev);
  EXPECT_THAT(parseView("{\"position_m\": 3}", "shot.png", planet).error().message,
              StartsWith("shot.png: /position_m: expected a list of 3"));
}

}  // namespace
}  // namespace welkin
