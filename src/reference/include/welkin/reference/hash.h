#pragma once
// Names for what was computed: a hash of all that it was computed from.
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace welkin::reference {

// Eight bytes at a time by multiplication and a fold (the step of SplitMix64): for names, not against malice.
class Hash {
 public:
  void add(std::uint64_t v) {
    state_ = (state_ ^ v) * 0x9E3779B97F4A7C15ull;
    state_ ^= state_ >> 29;
    state_ *= 0xBF58476D1CE4E5B9ull;
    state_ ^= state_ >> 32;
  }
  void add(double v) {
    std::uint64_t bits;
    std::memcpy(&bits, &v, 8);
    add(bits);
  }
  void add(const void* data, std::size_t bytes) {
    const auto* from = static_cast<const unsigned char*>(data);
    for (; bytes >= 8; from += 8, bytes -= 8) {
      std::uint64_t v;
      std::memcpy(&v, from, 8);
      add(v);
    }
    std::uint64_t rest = bytes;
    std::memcpy(reinterpret_cast<unsigned char*>(&rest) + 1, from, bytes);
    add(rest);
  }
  void add(std::string_view text) { add(text.data(), text.size()); }
  std::uint64_t value() const { return state_; }

 private:
  std::uint64_t state_ = 0x243F6A8885A308D3ull;  // pi's fraction
};

}  // namespace welkin::reference
