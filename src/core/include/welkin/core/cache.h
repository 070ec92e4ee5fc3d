#pragma once
// What took long to compute, on disk under all that it was computed from, so that it is not done again. $WELKIN_CACHE, else
// $XDG_CACHE_HOME/welkin, else ~/.cache/welkin; WELKIN_CACHE set to nothing: no cache.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace welkin {

// Fowler, Noll and Vo's FNV-1a, 64 bits: names files and finds broken ones.
std::uint64_t fnv1a(std::string_view bytes);

// Files of one kind: "NAME-HASH.bin". What a file holds is told by its whole key, not by the hash.
class Cache {
 public:
  // `magic`: one line at the head of each file, counted up when the same key would be given other data. `most`: files that are kept; the
  // least recently written go.
  Cache(std::string name, std::string magic, std::size_t most) : name_(std::move(name)), magic_(std::move(magic)), most_(most) {}
  // Nothing if there is none, or the file is not whole: then it is made again.
  std::optional<std::string> load(const std::string& key) const;
  // A folder that cannot be written is no error.
  void save(const std::string& key, std::string_view data) const;

 private:
  std::string contents(const std::string& key, std::string_view data) const;
  std::string name_, magic_;
  std::size_t most_;
};

// Appends a value's bytes to a key.
template <class T>
void appendBytes(std::string& key, const T& value) {
  key.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

}  // namespace welkin
