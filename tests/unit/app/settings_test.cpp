#include "welkin/app/settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

#include "welkin/app/places.h"
#include "welkin/core/files.h"
#include "welkin/physics/scene_io.h"

namespace welkin::app {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

struct KeptSettings : testing::Test {
  fs::path folder = fs::temp_directory_path() / ("welkin_settings_test_" + std::to_string(::getpid()));
  fs::path file = folder / "welkin" / "settings.json";
  void SetUp() override { fs::create_directories(folder / "welkin"); }
  void TearDown() override { fs::remove_all(folder); }
  int asides() const {
    int n = 0;
    for (const auto& entry : fs::directory_iterator(folder / "welkin")) n += entry.path().string().find(".broken-") != std::string::npos;
    return n;
  }
};

Settings some() {
  Settings s;
  s.width = 1600;
  s.height = 900;
  s.position = {-1920, 40};
  s.maximized = true;
  s.uiScale = 1.5;
  s.lastScene = "/home/caf\xc3\xa9/earth.json";
  s.preset = "high";
  s.bookmarks["the Alps \"at\" dawn"] = toView({46.123456789, 7.6, 3000, 180, -5, 2, 40, 1.25}, 6.36e6);
  s.bookmarks["far"].position_m = {1e10, -3, 0.1};
  s.presets["mine"].step = 0.111;
  s.presets["mine"].budget_bytes = 3ull << 30;
  return s;
}

TEST_F(KeptSettings, ComeBackToTheBit) {
  fs::remove_all(folder);  // the folder is made
  ASSERT_TRUE(saveSettings(some(), file).ok());
  const auto back = loadSettings(file);
  EXPECT_EQ(back.note, "");
  const Settings& s = back.settings;
  EXPECT_EQ(s.width, 1600);
  EXPECT_EQ(s.height, 900);
  EXPECT_EQ(s.position, some().position);
  EXPECT_TRUE(s.maximized);
  EXPECT_EQ(s.uiScale, 1.5);
  EXPECT_EQ(s.lastScene, some().lastScene);
  EXPECT_EQ(s.preset, "high");
  ASSERT_EQ(s.bookmarks.size(), 2u);
  for (const auto& [name, view] : some().bookmarks) EXPECT_EQ(viewToJson(s.bookmarks.at(name)), viewToJson(view));
  EXPECT_EQ(s.presets.at("mine").step, 0.111);
  EXPECT_EQ(s.presets.at("mine").budget_bytes, 3ull << 30);
  EXPECT_THAT(*readFile(file), HasSubstr("\n  \"version\": 1,\n"));
}

TEST_F(KeptSettings, NoneYet) {
  const auto loaded = loadSettings(file);
  EXPECT_EQ(loaded.note, "");
  EXPECT_EQ(loaded.settings.width, 1280);
  EXPECT_EQ(loadSettings({}).note, "");
  EXPECT_FALSE(saveSettings({}, {}).ok());
}

TEST_F(KeptSettings, MissingKeysAreDefaultsAndForeignOnesAreLeft) {
  ASSERT_TRUE(writeFile(file, R"({"version": 1, "ui_scale": 2, "theme": "blue", "window": {"colour": 3}})").ok());
  const auto loaded = loadSettings(file);
  EXPECT_EQ(loaded.note, "");
  EXPECT_EQ(loaded.settings.uiScale, 2);
  EXPECT_EQ(loaded.settings.height, 800);
}

TEST_F(KeptSettings, BrokenOnesAreSetAside) {
  const char* broken[] = {"",
                          "{",
                          "[]",
                          "{}",
                          "\xff\xfe nonsense \x01",
                          R"({"version": 2})",
                          R"({"version": "1"})",
                          R"({"version": 1, "ui_scale": "big"})",
                          R"({"version": 1, "ui_scale": 1e999})",
                          R"({"version": 1, "window": {"width": -5}})",
                          R"({"version": 1, "window": {"position": [1]}})",
                          R"({"version": 1, "bookmarks": {"a": {"position_m": [0, 0]}}})",
                          R"({"version": 1, "bookmarks": {"a": {"latitude_deg": 0, "longitude_deg": 0, "altitude_m": 5}}})",
                          R"({"version": 1, "presets": {"a": {"step": -1}}})",
                          R"({"version": 1, "last_scene": 5})"};
  int n = 0;
  for (const char* text : broken) {
    ASSERT_TRUE(writeFile(file, text).ok());
    const auto loaded = loadSettings(file);
    EXPECT_EQ(asides(), ++n) << text;
    EXPECT_THAT(loaded.note, HasSubstr("set aside as settings.json.broken-" + std::to_string(n)));
    EXPECT_EQ(loaded.note.find('\n'), std::string::npos);
    EXPECT_EQ(loaded.settings.width, 1280);
    EXPECT_FALSE(fs::exists(file));
    EXPECT_EQ(*readFile(fs::path(file.string() + ".broken-" + std::to_string(n))), text);
  }
  fs::create_directory(file);
  EXPECT_THAT(loadSettings(file).note, HasSubstr("expected a file"));
  ASSERT_TRUE(saveSettings(some(), file).ok());  // and all is well again
  EXPECT_EQ(loadSettings(file).note, "");
}

TEST_F(KeptSettings, CutAnywhere) {
  ASSERT_TRUE(saveSettings(some(), file).ok());
  const std::string whole = *readFile(file);
  for (std::size_t n = 0; n < whole.size(); n += 37) {
    ASSERT_TRUE(writeFile(file, whole.substr(0, n)).ok());
    EXPECT_NE(loadSettings(file).note, "") << n;
  }
}

TEST_F(KeptSettings, LieWhereTheyShould) {
  const auto with = [](const char* config, const char* home) {
    config != nullptr ? ::setenv("XDG_CONFIG_HOME", config, 1) : ::unsetenv("XDG_CONFIG_HOME");
    home != nullptr ? ::setenv("HOME", home, 1) : ::unsetenv("HOME");
    return settingsFile();
  };
  const std::string home = std::getenv("HOME") != nullptr ? std::getenv("HOME") : "";
  EXPECT_EQ(with("/c", "/h"), "/c/welkin/settings.json");
  EXPECT_EQ(with("relative", "/h"), "/h/.config/welkin/settings.json");
  EXPECT_EQ(with("", "/h"), "/h/.config/welkin/settings.json");
  EXPECT_EQ(with(nullptr, nullptr), "");
  ::setenv("HOME", home.c_str(), 1);
}

TEST_F(KeptSettings, NamesOfShots) {
  std::tm when{};
  when.tm_year = 126, when.tm_mon = 10, when.tm_mday = 22, when.tm_hour = 14, when.tm_min = 32;
  EXPECT_EQ(shotName(when, {7.2, 11.4, 9000, 0, 0, 0, 58, {}}), "welkin-2026-11-22-1432-07N-011E-9km");
  EXPECT_EQ(shotName(when, {-89.9, -179.9, 1.5, 0, 0, 0, 58, {}}), "welkin-2026-11-22-1432-90S-180W-2m");
}

TEST_F(KeptSettings, NamesAreNeverGivenTwice) {
  const fs::path shots = folder / "shots";
  ASSERT_EQ(*reserveFiles(shots, "a", {".png"}), shots / "a");
  ASSERT_EQ(*reserveFiles(shots, "a", {".png", ".exr"}), shots / "a-2");
  EXPECT_TRUE(fs::exists(shots / "a-2.exr"));
  ASSERT_TRUE(writeFile(shots / "a-3.exr", "mine").ok());
  ASSERT_EQ(*reserveFiles(shots, "a", {".png", ".exr"}), shots / "a-4");
  EXPECT_FALSE(fs::exists(shots / "a-3.png"));  // nothing is left of a try
  EXPECT_EQ(*readFile(shots / "a-3.exr"), "mine");
  EXPECT_FALSE(reserveFiles(shots / "a.png", "b", {".png"}).ok());
}

TEST_F(KeptSettings, TheProgramKnowsItsFolder) { EXPECT_TRUE(fs::exists(programFolder() / "scenes" / "earth.json")); }

}  // namespace
}  // namespace welkin::app
