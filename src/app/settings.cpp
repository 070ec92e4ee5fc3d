#include "welkin/app/settings.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "welkin/app/places.h"
#include "welkin/core/files.h"
#include "welkin/physics/scene_io.h"

namespace welkin::app {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;
constexpr std::uint64_t kMostBytes = 4 << 20;  // ten thousand bookmarks

struct Bad {
  std::string what;
};

double number(const Json& value, const char* key, double low, double high) {
  if (!value.is_number() || !(value.get<double>() >= low && value.get<double>() <= high)) {
    throw Bad{fmt::format("{}: expected a number from {} to {}", key, low, high)};
  }
  return value.get<double>();
}

std::string text(const Json& value, const char* key) {
  if (!value.is_string()) throw Bad{fmt::format("{}: expected a text", key)};
  return value.get<std::string>();
}

const Json& object(const Json& value, const char* key) {
  if (!value.is_object()) throw Bad{fmt::format("{}: expected an object", key)};
  return value;
}

// The quality section as scene files have it: one reader and one writer for both.
Json qualityToJson(const Quality& quality) {
  Scene scene;
  scene.quality = quality;
  return Json::parse(sceneToJson(scene))["quality"];
}

Quality qualityFrom(const Json& value, const std::string& place) {
  const auto scene = parseScene(Json{{"quality", value}}.dump(), place);
  if (!scene) throw Bad{scene.error().message};
  return scene->quality;
}

View viewFrom(const Json& value, const std::string& place) {
  if (!value.is_object() || !value.contains("position_m")) throw Bad{place + ": expected position_m and orientation_xyzw"};
  Planet anyPlanet;  // a bookmark does not say of which; the camera keeps above the ground of the one it flies over
  anyPlanet.radius_m = 0;
  const auto view = parseView(value.dump(), place, anyPlanet);
  if (!view) throw Bad{view.error().message};
  return *view;
}

Settings read(const Json& root) {
  object(root, "the whole file");
  if (!root.contains("version")) throw Bad{"expected the key \"version\""};
  const double version = number(root["version"], "version", 1, 1e9);
  if (version > kSettingsVersion) throw Bad{fmt::format("version {} is newer than this program's {}", version, kSettingsVersion)};
  Settings s;
  for (const auto& [key, value] : root.items()) {  // a key of someone else's does no harm
    if (key == "window") {
      for (const auto& [name, v] : object(value, "window").items()) {
        if (name == "width") s.width = int(number(v, "window.width", 1, 65536));
        if (name == "height") s.height = int(number(v, "window.height", 1, 65536));
        if (name == "maximized") s.maximized = v.is_boolean() && v.get<bool>();
        if (name == "position") {
          if (!v.is_array() || v.size() != 2) throw Bad{"window.position: expected a list of 2"};
          s.position = {int(number(v[0], "window.position", -1e6, 1e6)), int(number(v[1], "window.position", -1e6, 1e6))};
        }
      }
    } else if (key == "ui_scale") {
      s.uiScale = number(value, "ui_scale", 0, 10);
    } else if (key == "last_scene") {
      s.lastScene = text(value, "last_scene");
    } else if (key == "preset") {
      s.preset = text(value, "preset");
    } else if (key == "bookmarks") {
      for (const auto& [name, v] : object(value, "bookmarks").items()) s.bookmarks[name] = viewFrom(v, "bookmarks." + name);
    } else if (key == "presets") {
      for (const auto& [name, v] : object(value, "presets").items()) s.presets[name] = qualityFrom(v, "presets." + name);
    }
  }
  return s;
}

std::string write(const Settings& s) {
  Json out;
  out["version"] = kSettingsVersion;
  out["window"] = {{"width", s.width}, {"height", s.height}, {"maximized", s.maximized}};
  if (s.position) out["window"]["position"] = {s.position->first, s.position->second};
  out["ui_scale"] = s.uiScale;
  out["last_scene"] = s.lastScene.generic_string();
  out["preset"] = s.preset;
  out["bookmarks"] = Json::object();
  for (const auto& [name, view] : s.bookmarks) out["bookmarks"][name] = Json::parse(viewToJson(view));
  out["presets"] = Json::object();
  for (const auto& [name, quality] : s.presets) out["presets"][name] = qualityToJson(quality);
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string setAside(const fs::path& file) {
  std::error_code ec;
  for (int n = 1; n < 1000; ++n) {
    const fs::path aside = fmt::format("{}.broken-{}", file.string(), n);
    if (fs::symlink_status(aside, ec).type() != fs::file_type::not_found) continue;
    fs::rename(file, aside, ec);
    if (!ec) return "set aside as " + aside.filename().string();
    break;
  }
  return "it could not be set aside";
}

}  // namespace

fs::path settingsFile() {
  const fs::path folder = configFolder();
  return folder.empty() ? folder : folder / "settings.json";
}

LoadedSettings loadSettings(const fs::path& file) {
  std::error_code ec;
  if (file.empty() || fs::symlink_status(file, ec).type() == fs::file_type::not_found) return {};
  std::string why;
  if (auto bytes = readFile(file, kMostBytes); !bytes) {
    why = bytes.error().message;
  } else {
    try {
      return {read(Json::parse(*bytes)), {}};
    } catch (const Bad& bad) {
      why = fmt::format("{}: {}", file.string(), bad.what);
    } catch (const std::exception& e) {
      why = fmt::format("{}: expected JSON: {}", file.string(), e.what());
    }
  }
  return {{}, oneLine(fmt::format("{}; {}, the settings are the default ones", why, setAside(file)), 1000)};
}

Result<void> saveSettings(const Settings& settings, const fs::path& file) {
  if (file.empty()) return Error{"settings are not kept: neither XDG_CONFIG_HOME nor HOME is set"};
  if (auto folder = makeWritableFolder(file.parent_path()); !folder) return folder.error();
  return writeFile(file, write(settings));
}

}  // namespace welkin::app
