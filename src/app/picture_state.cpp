#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "picture_thesis.h"
#include "welkin/app/picture.h"
#include "welkin/core/files.h"
#include "welkin/core/units.h"
#include "welkin/physics/path_io.h"
#include "welkin/physics/scene_io.h"
#include "welkin/physics/scene_time.h"

namespace welkin::app {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

fs::path folderOf(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

fs::path relativeTo(const fs::path& file, const fs::path& folder) {
  return fs::absolute(file).lexically_normal().lexically_proximate(fs::absolute(folder).lexically_normal());
}

struct BadState {
  std::string message;
};

class Reader {
 public:
  Reader(const Texts& texts, const fs::path& picture) : texts_(texts), picture_(picture.string()) {}

  bool has(const std::string& key) const {
    return std::any_of(texts_.begin(), texts_.end(), [&](const auto& entry) { return entry.first == key; });
  }
  const std::string& text(const std::string& key) const {
    for (const auto& [name, value] : texts_) {
      if (name == key) return value;
    }
    throw BadState{fmt::format("{}: not a picture of this program: expected the text \"{}\"", picture_, key)};
  }
  std::string place(const std::string& key) const { return picture_ + ": " + key; }

  Json object(const std::string& key) const {
    auto value = Json::parse(text(key), nullptr, false);
    if (!value.is_object()) fail(key, "a JSON object");
    return value;
  }
  int edge(const Json& settings, const char* key) const {
    const auto found = settings.find(key);
    const bool whole =
        found != settings.end() && found->is_number_unsigned() && found->get<std::uint64_t>() <= std::uint64_t(kMaxPictureEdge);
    if (!whole || found->get<int>() < 1)
      fail(std::string("welkin:settings: /") + key, fmt::format("a whole number from 1 to {}", kMaxPictureEdge));
    return found->get<int>();
  }
  double number(const Json& object, const char* key) const {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_number() || !std::isfinite(found->get<double>())) {
      fail(std::string("welkin:settings: /") + key, "a number");
    }
    return found->get<double>();
  }
  double number(const std::string& key, double most) const {
    const std::string& value = text(key);
    double out = 0;
    const auto parsed = std::from_chars(value.data(), value.data() + value.size(), out);
    if (parsed.ec != std::errc() || parsed.ptr != value.data() + value.size() || !(std::abs(out) <= most))
      fail(key, fmt::format("a number of {:g} at most", most));
    return out;
  }
  [[noreturn]] void fail(const std::string& key, const std::string& expected) const {
    throw BadState{fmt::format("{}: {}: expected {}", picture_, key, expected)};
  }

 private:
  const Texts& texts_;
  std::string picture_;
};

// Nothing for a name of another version: what the picture shows was drawn from scene and view all the same.
std::optional<DebugView> debugViewNamed(const std::string& name) {
  const auto found = std::find(kDebugViewNames.begin(), kDebugViewNames.end(), name);
  if (found == kDebugViewNames.end()) return {};
  return DebugView(found - kDebugViewNames.begin());
}

}  // namespace

Texts textsFromState(const PictureState& s, const fs::path& folder) {
  const auto& q = s.scene.quality;
  const Json settings{{"width", s.width}, {"height", s.height}, {"budget", bytesExact(q.budget_bytes)}, {"depth", q.depth},
                      {"step", q.step},   {"detail", q.detail}, {"exposure_ev", s.exposure_ev}};
  Json data = Json::object();
  for (const auto& [file, sum] : s.data) data[relativeTo(file, folder).generic_string()] = sum;
  Texts texts{{"welkin:scene", sceneToJson(s.scene, folder, -1)},
          {"welkin:view", viewToJson(s.view)},
          {"welkin:settings", settings.dump()},
          {"welkin:seed", std::to_string(q.seed)},
          {"welkin:time_s", fmt::format("{:.17g}", s.time_s)},
          {"welkin:data", data.dump(-1, ' ', false, Json::error_handler_t::replace)},
          {"welkin:build", s.build},
          {"welkin:converged", s.converged ? "1" : "0"}};
  if (s.debug != DebugView::None) texts.emplace_back("welkin:debug", kDebugViewNames[std::size_t(s.debug)]);
  return texts;
}

Result<PictureState> stateFromTexts(const Texts& texts, const fs::path& picture) {
  try {
    const Reader in(texts, picture);
    if (!in.has("welkin:scene") && isThesisPicture(texts)) return stateOfThesisPicture(texts, picture);
    PictureState s;
    auto scene = parseScene(in.text("welkin:scene"), in.place("welkin:scene"), folderOf(picture));
    if (!scene) return scene.error();
    s.scene = std::move(*scene);
    s.scene.file = picture;
    auto view = parseView(in.text("welkin:view"), in.place("welkin:view"), s.scene.planet);
    if (!view) return view.error();
    s.view = *view;
    // What an older version did not write has a stand-in, and a note of it.
    const auto there = [&](bool is, const char* what, const char* instead) {
      if (!is) s.notes.push_back(fmt::format("{}: {} is missing: {}", picture.string(), what, instead));
      return is;
    };
    const auto settings = in.has("welkin:settings") ? in.object("welkin:settings") : Json::object();
    if (there(settings.contains("width") && settings.contains("height"), "welkin:settings: /width or /height", "the picture's own size")) {
      s.width = in.edge(settings, "width");
      s.height = in.edge(settings, "height");
    }
    const bool exposed = settings.contains("exposure_ev");
    if (there(exposed, "welkin:settings: /exposure_ev", "the scene's exposure"))
      s.exposure_ev = in.number(settings, "exposure_ev");
    else
      s.exposure_ev = s.view.exposure_ev.value_or(s.scene.output.exposure_ev.value_or(0));
    if (there(in.has("welkin:time_s"), "welkin:time_s", "scene time 0")) s.time_s = in.number("welkin:time_s", kGreatestTime_s);
    if (there(in.has("welkin:build"), "welkin:build", "what made it is not known")) s.build = in.text("welkin:build");
    if (there(in.has("welkin:converged"), "welkin:converged", "taken as not converged")) s.converged = in.text("welkin:converged") == "1";
    if (in.has("welkin:debug")) {
      const auto debug = debugViewNamed(in.text("welkin:debug"));
      if (there(debug.has_value(), "welkin:debug: a debug view that this version knows", "the picture without one")) s.debug = *debug;
    }
    if (!there(in.has("welkin:data"), "welkin:data", "data files are not checked")) {
      for (const auto& file : dataFiles(s.scene)) s.data[file] = "";
      return s;
    }
    const auto data = in.object("welkin:data");
    for (const auto& entry : data.items()) {
      if (!entry.value().is_string()) in.fail("welkin:data", "a checksum for every file");
      s.data[fs::absolute(folderOf(picture) / entry.key()).lexically_normal()] = entry.value().get<std::string>();
    }
    return s;
  } catch (const BadState& bad) {
    return Error{bad.message};
  }
}

}  // namespace welkin::app
