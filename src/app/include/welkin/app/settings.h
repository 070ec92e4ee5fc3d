#pragma once
// What the window remembers between runs: docs/files.md, "Settings".
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "welkin/core/result.h"
#include "welkin/physics/scene.h"

namespace welkin::app {

constexpr int kSettingsVersion = 1;

struct Settings {
  int width = 1280, height = 800;  // of the window, in screen coordinates
  std::optional<std::pair<int, int>> position;
  bool maximized = false;
  double uiScale = 0;  // 0: as the monitor says
  std::filesystem::path lastScene;
  std::string preset;                      // of quality, by name; empty: the scene's own
  std::map<std::string, View> bookmarks;   // planet frame
  std::map<std::string, Quality> presets;  // the user's own, beside the built-in ones
};

std::filesystem::path settingsFile();  // settings.json in configFolder(); empty: there is no home, and nothing is kept

struct LoadedSettings {
  Settings settings;
  std::string note;  // one line for the user, if something was wrong
};
// Never fails. A file that is broken, or of a newer version, is renamed to FILE.broken-1 (-2, …), and the settings are the default ones.
LoadedSettings loadSettings(const std::filesystem::path& file);
// All or nothing; makes the folder.
Result<void> saveSettings(const Settings& settings, const std::filesystem::path& file);

}  // namespace welkin::app
