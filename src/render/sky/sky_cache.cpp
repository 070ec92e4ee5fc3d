#include "sky_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "welkin/core/files.h"

namespace welkin {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "welkin field 1\n";  // counted up when sky_field.cpp makes other fields of the same parameters

fs::path folder() {
  if (const char* set = std::getenv("WELKIN_CACHE")) return set;
  if (const char* set = std::getenv("XDG_CACHE_HOME"); set && *set) return fs::path(set) / "welkin";
  if (const char* home = std::getenv("HOME"); home && *home) return fs::path(home) / ".cache" / "welkin";
  return {};
}

// Fowler, Noll and Vo's FNV-1a, 64 bits: names files and finds broken ones. Which field a file holds is told by its whole key.
std::uint64_t fnv(std::string_view bytes) {
  std::uint64_t h = 0xcbf29ce484222325u;
  for (const unsigned char c : bytes) h = (h ^ c) * 0x100000001b3u;
  return h;
}

fs::path fileOf(const std::string& key) { return folder() / fmt::format("field-{:016x}.bin", fnv(key)); }

template <class T>
void append(std::string& out, const T& value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  out.append(bytes, sizeof(T));
}

std::string contents(const std::string& key, std::string_view data) {
  std::string out(kMagic);
  append(out, std::uint64_t(key.size()));
  out += key;
  append(out, fnv(data));
  out += data;
  return out;
}

}  // namespace

std::string fieldKey(const shared::AirBlock& air, const SkyModel& m, const std::string& shaders, const std::string& renderer) {
  shared::AirBlock own = air;
  own.view = {};
  own.params.sunR = own.params.sunG = own.params.sunB = 0;
  std::string key;
  append(key, own);
  for (const std::int64_t n : {std::int64_t(m.degree), std::int64_t(m.zonal), std::int64_t(m.sunTexels), std::int64_t(m.altitudeTexels), std::int64_t(m.above),
                               std::int64_t(m.below), std::int64_t(m.azimuths), std::int64_t(m.peakAngles), std::int64_t(m.peakAzimuths), std::int64_t(m.pieces),
                               std::int64_t(m.maxOrders)})
    append(key, n);
  append(key, m.rest);
  append(key, fnv(shaders));
  return key + renderer;
}

std::optional<std::vector<glm::vec4>> loadField(const std::string& key, std::size_t count) {
  if (folder().empty()) return {};
  const auto bytes = readFile(fileOf(key));
  if (!bytes) return {};
  const std::size_t head = kMagic.size() + sizeof(std::uint64_t) + key.size() + sizeof(std::uint64_t);
  if (bytes->size() != head + count * sizeof(glm::vec4)) return {};
  std::vector<glm::vec4> field(count);
  const std::string_view data = std::string_view(*bytes).substr(head);
  if (contents(key, data) != *bytes) return {};
  std::memcpy(field.data(), data.data(), data.size());
  return field;
}

void saveField(const std::string& key, const std::vector<glm::vec4>& field) {
  const fs::path to = folder();
  if (to.empty()) return;
  std::error_code ignored;
  fs::create_directories(to, ignored);
  const std::string_view data(reinterpret_cast<const char*>(field.data()), field.size() * sizeof(glm::vec4));
  if (!writeFile(fileOf(key), contents(key, data))) return;
  std::vector<std::pair<fs::file_time_type, fs::path>> all;
  for (const auto& entry : fs::directory_iterator(to, ignored))
    if (entry.path().extension() == ".bin" && entry.path().filename().string().starts_with("field-"))
      all.emplace_back(entry.last_write_time(ignored), entry.path());
  if (all.size() <= kCachedFields) return;
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i + kCachedFields < all.size(); ++i) fs::remove(all[i].second, ignored);
}

}  // namespace welkin
