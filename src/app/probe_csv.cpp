#include "probe_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "welkin/core/files.h"

namespace welkin::app {
namespace {

constexpr std::uint64_t kMaxTableBytes = 256 << 20;  // millions of rays
constexpr double kRad = std::numbers::pi / 180;

struct Column {
  const char* name;
  double low, high, scale;
  const char* unit;
  double ProbeRay::*value;
  bool required;
};
constexpr double kFarthest_m = 1e12;  // of any place in a scene
constexpr std::array kColumns{
    Column{"altitude_m", -kFarthest_m, kFarthest_m, 1, "metres", &ProbeRay::altitude_m, true},
    Column{"sun_zenith_deg", 0, 180, kRad, "degrees", &ProbeRay::sunZenith_rad, true},
    Column{"view_zenith_deg", 0, 180, kRad, "degrees", &ProbeRay::viewZenith_rad, true},
    Column{"relative_azimuth_deg", -360, 360, kRad, "degrees", &ProbeRay::azimuth_rad, true},
    Column{"max_distance_m", 0, HUGE_VAL, 1, "metres", &ProbeRay::maxDistance_m, false},
    Column{"latitude_deg", -90, 90, kRad, "degrees", &ProbeRay::latitude_rad, false},
    Column{"longitude_deg", -360, 360, kRad, "degrees", &ProbeRay::longitude_rad, false},
};

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string_view::npos ? "" : std::string(text.substr(first, last - first + 1));
}

std::vector<std::string> fieldsOf(const std::string& line) {
  std::vector<std::string> out;
  std::size_t from = 0;
  while (true) {
    const auto comma = line.find(',', from);
    out.push_back(trimmed(std::string_view(line).substr(from, comma - from)));
    if (comma == std::string::npos) return out;
    from = comma + 1;
  }
}

std::optional<double> numberOf(const std::string& text) {
  char* end = nullptr;
  const double v = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || std::isnan(v)) return std::nullopt;
  return v;
}

using Order = std::vector<const Column*>;

Result<Order> readHeader(const std::string& line, const std::string& where) {
  Order order;
  for (const std::string& name : fieldsOf(line)) {
    const Column* found = nullptr;
    for (const Column& c : kColumns)
      if (name == c.name) found = &c;
    if (!found)
      return Error{
          fmt::format("{}: column {}: expected the name of a column of rays, got '{}'", where, order.size() + 1, oneLine(name, 60))};
    if (std::find(order.begin(), order.end(), found) != order.end())
      return Error{fmt::format("{}: column {}: expected each column once, got {} again", where, order.size() + 1, name)};
    order.push_back(found);
  }
  const auto has = [&](const Column& c) { return std::find(order.begin(), order.end(), &c) != order.end(); };
  for (const Column& c : kColumns)
    if (c.required && !has(c)) return Error{fmt::format("{}: expected a column {}", where, c.name)};
  if (has(kColumns[5]) != has(kColumns[6])) return Error{where + ": expected latitude_deg and longitude_deg together"};
  return order;
}

Result<ProbeRay> readRow(const std::string& line, const Order& order, const std::string& where) {
  const auto fields = fieldsOf(line);
  if (fields.size() != order.size()) return Error{fmt::format("{}: expected {} columns, got {}", where, order.size(), fields.size())};
  ProbeRay ray;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Column& c = *order[i];
    if (fields[i].empty() && c.value == &ProbeRay::maxDistance_m) continue;
    const auto v = numberOf(fields[i]);
    if (!v || *v < c.low || *v > c.high) {
      const std::string range = std::isinf(c.high) ? fmt::format("at least {}", c.low) : fmt::format("from {} to {}", c.low, c.high);
      return Error{fmt::format("{}: {}: expected {} {}, got '{}'", where, c.name, c.unit, range, oneLine(fields[i], 60))};
    }
    ray.*c.value = *v * c.scale;
  }
  return ray;
}

}  // namespace

Result<ProbeTable> parseProbeTable(const std::string& text, const std::string& sourceName) {
  ProbeTable out;
  Order order;
  std::size_t from = text.starts_with("\xEF\xBB\xBF") ? 3 : 0;  // a byte order mark, as spreadsheets write it
  for (int number = 1; from < text.size(); ++number) {
    const auto end = std::min(text.find('\n', from), text.size());
    std::string line = text.substr(from, end - from);
    from = end + 1;
    if (line.ends_with('\r')) line.pop_back();
    if (trimmed(line).empty()) continue;
    const std::string where = fmt::format("{}: line {}", sourceName, number);
    if (order.empty()) {
      auto header = readHeader(line, where);
      if (!header) return header.error();
      order = *header;
      out.header = line;
      continue;
    }
    auto ray = readRow(line, order, where);
    if (!ray) return ray.error();
    out.rows.push_back(line);
    out.rays.push_back(*ray);
  }
  if (order.empty()) return Error{sourceName + ": line 1: expected the names of the columns, found nothing"};
  return out;
}

Result<ProbeTable> readProbeTable(const std::filesystem::path& file) {
  auto text = readFile(file, kMaxTableBytes);
  if (!text) return text.error();
  return parseProbeTable(*text, file.string());
}

std::string probeResultText(const ProbeTable& table, const std::vector<ProbeResult>& results, bool withErrors) {
  std::string out = table.header;
  for (const char* kind : {"radiance", "transmittance", "standard_error"})
    if (withErrors || kind != std::string_view("standard_error"))
      for (const int wavelength_nm : {680, 550, 440}) out += fmt::format(",{}_{}", kind, wavelength_nm);
  out += '\n';
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    out += table.rows[i];
    const auto add = [&](const Spectrum3& values) {
      for (const double v : values) out += fmt::format(",{:.9g}", v);
    };
    add(results[i].radiance);
    add(results[i].transmittance);
    if (withErrors) add(results[i].standardError);
    out += '\n';
  }
  return out;
}

}  // namespace welkin::app
