#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "welkin/app/flight_result.h"

namespace welkin::app {
namespace {

using Json = nlohmann::ordered_json;

std::optional<double> ratioOf(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b || !(*a > 0)) return {};
  return *b / *a;
}

template <class Pairs>
auto find(const Pairs& pairs, const std::string& name) {
  return std::find_if(pairs.begin(), pairs.end(), [&](const auto& p) { return p.first == name; });
}

std::optional<double> passOf(const FlightResult& r, const std::string& name) {
  const auto found = find(r.passes_ms, name);
  return found == r.passes_ms.end() ? std::optional<double>{} : found->second;
}

std::string settingOf(const FlightResult& r, const std::string& name) {
  const auto found = find(r.settings, name);
  return found == r.settings.end() ? "-" : found->second;
}

double framesPerSecond(const FlightResult& r) { return r.median_ms > 0 ? 1000 / r.median_ms : 0; }

}  // namespace

ResultComparison compareResults(const FlightResult& a, const FlightResult& b) {
  ResultComparison out;
  const auto time = [&](const std::string& name, std::optional<double> x, std::optional<double> y) {
    out.rows.push_back({name, x, y, ratioOf(x, y), "ms", false});
  };
  const auto other = [&](const std::string& name, std::optional<double> x, std::optional<double> y, const char* unit, bool counted) {
    out.rows.push_back({name, x, y, {}, unit, counted});
  };
  time("frame, median", a.median_ms, b.median_ms);
  time("frame, p95", a.p95_ms, b.p95_ms);
  time("frame, p99", a.p99_ms, b.p99_ms);
  time("frame, max", a.max_ms, b.max_ms);
  out.rows.push_back(
      {"frames a second", framesPerSecond(a), framesPerSecond(b), ratioOf(framesPerSecond(a), framesPerSecond(b)), "", false});
  for (const auto& [name, ms] : a.passes_ms) time(name, ms, passOf(b, name));
  for (const auto& [name, ms] : b.passes_ms)
    if (find(a.passes_ms, name) == a.passes_ms.end()) time(name, {}, ms);
  other("waited in all", a.wait_ms, b.wait_ms, "ms", false);
  other("frames", double(a.frame_ms.size()), double(b.frame_ms.size()), "", true);
  other("memory at most", a.greatestBytes / (1 << 20), b.greatestBytes / (1 << 20), "MiB", false);
  if (a.rmse_255 || b.rmse_255) other("RMSE, 0-255", a.rmse_255, b.rmse_255, "", false);
  other("not a number", a.nanPixels, b.nanPixels, "pixels", true);
  other("holes", a.holes, b.holes, "rays", true);
  for (const auto& [name, text] : a.settings)
    if (settingOf(b, name) != text) out.different.push_back({name, text, settingOf(b, name)});
  for (const auto& [name, text] : b.settings)
    if (find(a.settings, name) == a.settings.end()) out.different.push_back({name, "-", text});
  if (a.stopped != b.stopped) out.different.push_back({"stopped early", a.stopped ? "yes" : "no", b.stopped ? "yes" : "no"});
  return out;
}

std::string valueText(const ComparedRow& row, const std::optional<double>& value) {
  if (!value) return "-";
  return row.counted || *value >= 1000 || *value == 0 ? fmt::format("{:.0f}", *value) : fmt::format("{:#.4g}", *value);
}

std::string ratioText(const ComparedRow& row) { return row.ratio ? fmt::format("{:.3f}", *row.ratio) : ""; }

std::string comparisonText(const ResultComparison& c) {
  std::size_t width = 0, name = 0;
  for (const auto& row : c.rows) width = std::max(width, row.name.size());
  std::string out = fmt::format("{:<{}}  {:>10}  {:>10}  {:>8}\n", "", width, "A", "B", "B / A");
  for (const auto& row : c.rows) {
    std::string text = fmt::format("{:<{}}  {:>10}  {:>10}  {:>8}  {}", row.name, width, valueText(row, row.a), valueText(row, row.b),
                                   ratioText(row), row.unit);
    text.erase(text.find_last_not_of(' ') + 1);
    out += text + "\n";
  }
  if (c.different.empty()) return out + "\nsame settings, scene and device\n";
  out += "\ndifferent:\n";
  for (const auto& d : c.different) name = std::max(name, d.name.size());
  for (const auto& d : c.different) out += fmt::format("  {:<{}}  A {}\n  {:<{}}  B {}\n", d.name, name, d.a, "", name, d.b);
  return out;
}

std::string comparisonJson(const FlightResult& a, const FlightResult& b) {
  const ResultComparison c = compareResults(a, b);
  Json out{{"a", a.file.generic_string()}, {"b", b.file.generic_string()}, {"rows", Json::array()}, {"different", Json::array()}};
  for (const auto& row : c.rows) {
    Json one{{"name", row.name}};
    if (row.a) one["a"] = *row.a;
    if (row.b) one["b"] = *row.b;
    if (row.ratio) one["b_over_a"] = *row.ratio;
    if (*row.unit != '\0') one["unit"] = row.unit;
    out["rows"].push_back(std::move(one));
  }
  for (const auto& d : c.different) out["different"].push_back({{"name", d.name}, {"a", d.a}, {"b", d.b}});
  return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace welkin::app
