#include "welkin/core/cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "welkin/core/files.h"

namespace welkin {
namespace {

namespace fs = std::filesystem;

fs::path folder() {
  if (const char* set = std::getenv("WELKIN_CACHE")) return set;
  if (const char* set = std::getenv("XDG_CACHE_HOME"); set && *set) return fs::path(set) / "welkin";
  if (const char* home = std::getenv("HOME"); home && *home) return fs::path(home) / ".cache" / "welkin";
  return {};
}

fs::path fileOf(const std::string& name, const std::string& key) { return folder() / fmt::format("{}-{:016x}.bin", name, fnv1a(key)); }

}  // namespace

std::uint64_t fnv1a(std::string_view bytes) {
  std::uint64_t h = 0xcbf29ce484222325u;
  for (const unsigned char c : bytes) h = (h ^ c) * 0x100000001b3u;
  return h;
}

std::string Cache::contents(const std::string& key, std::string_view data) const {
  std::string out(magic_);
  appendBytes(out, std::uint64_t(key.size()));
  out += key;
  appendBytes(out, fnv1a(data));
  out += data;
  return out;
}

std::optional<std::string> Cache::load(const std::string& key) const {
  if (folder().empty()) return {};
  const auto bytes = readFile(fileOf(name_, key));
  const std::size_t head = magic_.size() + sizeof(std::uint64_t) + key.size() + sizeof(std::uint64_t);
  if (!bytes || bytes->size() < head) return {};
  std::string data = bytes->substr(head);
  if (contents(key, data) != *bytes) return {};
  return data;
}

void Cache::save(const std::string& key, std::string_view data) const {
  const fs::path to = folder();
  if (to.empty()) return;
  std::error_code ignored;
  fs::create_directories(to, ignored);
  if (!writeFile(fileOf(name_, key), contents(key, data))) return;
  std::vector<std::pair<fs::file_time_type, fs::path>> all;
  for (const auto& entry : fs::directory_iterator(to, ignored))
    if (entry.path().extension() == ".bin" && entry.path().filename().string().starts_with(name_ + "-"))
      all.emplace_back(entry.last_write_time(ignored), entry.path());
  if (all.size() <= most_) return;
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i + most_ < all.size(); ++i) fs::remove(all[i].second, ignored);
}

}  // namespace welkin
