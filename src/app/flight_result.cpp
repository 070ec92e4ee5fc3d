#include "welkin/app/flight_result.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "welkin/core/files.h"
#include "welkin/core/units.h"
#include "welkin/measure/statistics.h"

namespace welkin::app {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::uint64_t kMostBytes = 1 << 30;  // of a flight of half a million frames
constexpr const char* kMark = "frame_ms";      // of all files of this program, results alone have it

struct Bad {
  std::string what;
};

const Json& at(const Json& object, const char* key) {
  if (!object.is_object() || !object.contains(key)) throw Bad{fmt::format("expected the key \"{}\" of a result of `welkin fly`", key)};
  return object[key];
}

double number(const Json& object, const char* key) {
  const Json& value = at(object, key);
  if (!value.is_number() || !std::isfinite(value.get<double>()) || value.get<double>() < 0)
    throw Bad{fmt::format("/{}: expected a number of at least 0", key)};
  return value.get<double>();
}

double numberOr(const Json& object, const char* key, double otherwise) { return object.contains(key) ? number(object, key) : otherwise; }

std::string plainText(const Json& value) {
  if (value.is_structured()) throw Bad{"/context: expected plain values"};
  return oneLine(value.is_string() ? value.get<std::string>() : value.dump(-1, ' ', false, Json::error_handler_t::replace), 500);
}

// The context's words that a comparison has to tell apart, under the names that users know.
void readSettings(const Json& context, FlightResult& out) {
  if (!context.is_object()) throw Bad{"/context: expected an object"};
  const auto add = [&](const char* name, std::string text) { out.settings.emplace_back(name, std::move(text)); };
  const Json none = Json::object();
  const Json& settings = context.contains("settings") ? context["settings"] : none;
  if (!settings.is_object()) throw Bad{"/context/settings: expected an object"};
  if (settings.contains("width") && settings.contains("height"))
    add("size", plainText(settings["width"]) + "x" + plainText(settings["height"]));
  for (const auto& [name, value] : settings.items()) {
    if (name == "width" || name == "height") continue;
    if (name == "budget_bytes" && value.is_number_unsigned())
      add("budget", bytesText(value.get<std::uint64_t>()));
    else
      add(name.c_str(), plainText(value));
  }
  for (const char* name : {"scene", "path", "gl_renderer", "gl_version", "cpu", "num_cpus", "build", "commit", "timer"})
    if (context.contains(name)) add(name, plainText(context[name]));
  if (context.contains("data") && context["data"].is_object())
    for (const auto& [name, value] : context["data"].items()) add(name.c_str(), plainText(value));
}

FlightResult read(const Json& root) {
  FlightResult out;
  const Json& frames = at(root, "frames");
  at(root, kMark);
  if (!frames.is_array() || frames.empty()) throw Bad{"/frames: expected a list of frames, not empty"};
  out.frame_ms.reserve(frames.size());
  for (const Json& frame : frames) out.frame_ms.push_back(number(frame, "wall_ms"));
  out.median_ms = measure::quantile(out.frame_ms, 0.5), out.p95_ms = measure::quantile(out.frame_ms, 0.95);
  out.p99_ms = measure::quantile(out.frame_ms, 0.99), out.max_ms = measure::quantile(out.frame_ms, 1);
  const Json& passes = at(root, "passes");
  if (!passes.is_object()) throw Bad{"/passes: expected an object"};
  for (const auto& [name, times] : passes.items()) out.passes_ms.emplace_back(oneLine(name, 40), number(times, "median_ms"));
  if (root.contains("wait_ms")) out.wait_ms = numberOr(root["wait_ms"], "total_ms", 0);
  out.nanPixels = number(root, "nan_pixels");
  out.holes = numberOr(root, "holes", 0);
  out.glMessages = numberOr(root, "gl_debug_messages", 0);
  if (root.contains("residency")) out.greatestBytes = numberOr(root["residency"], "greatest_bytes", 0);
  if (root.contains("quality") && root["quality"].is_object() && root["quality"].contains("rmse_255"))
    out.rmse_255 = number(root["quality"]["rmse_255"], "median");
  out.stopped = root.contains("stopped") && root["stopped"].is_boolean() && root["stopped"].get<bool>();
  readSettings(at(root, "context"), out);
  return out;
}

}  // namespace

bool isFlightResult(const std::filesystem::path& file) {
  const auto bytes = readFile(file, kMostBytes);
  if (!bytes) return false;
  const auto outermost = [](int depth, Json::parse_event_t, Json&) { return depth <= 1; };
  const Json root = Json::parse(*bytes, outermost, false);
  return root.is_object() && root.contains(kMark);
}

Result<FlightResult> parseFlightResult(std::string_view text, const std::string& sourceName) {
  try {
    FlightResult out = read(Json::parse(text));
    out.file = sourceName;
    return out;
  } catch (const Bad& bad) {
    return Error{fmt::format("{}: {}", sourceName, bad.what)};
  } catch (const std::exception& e) {
    return Error{oneLine(fmt::format("{}: expected JSON: {}", sourceName, e.what()), 1000)};
  }
}

Result<FlightResult> loadFlightResult(const std::filesystem::path& file) {
  const auto bytes = readFile(file, kMostBytes);
  if (!bytes) return bytes.error();
  return parseFlightResult(*bytes, file.string());
}

}  // namespace welkin::app
