#include "welkin/core/units.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace welkin {
namespace {
struct Unit {
  const char* name;
  int shift;
};
constexpr Unit kUnits[] = {{"GiB", 30}, {"MiB", 20}, {"KiB", 10}, {"B", 0}};
}  // namespace

Result<std::uint64_t> parseBytes(std::string_view text) {
  const Error wrong{"expected an amount of memory such as 512MiB (KiB, MiB, GiB)"};
  double value = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value, std::chars_format::fixed);
  if (parsed.ec != std::errc() || !std::isfinite(value) || value < 0) return wrong;
  std::string_view unit(parsed.ptr, static_cast<std::size_t>(end - parsed.ptr));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  int shift = unit.empty() ? 0 : -1;
  for (const auto& known : kUnits) {
    if (unit == known.name) shift = known.shift;
  }
  if (shift < 0) return wrong;
  const double bytes = std::ldexp(value, shift);
  if (bytes > 0x1p52) return wrong;  // past it a double skips whole numbers; no machine has as much
  return static_cast<std::uint64_t>(bytes);
}

std::string bytesText(std::uint64_t bytes) {
  for (const auto& unit : kUnits) {
    if (bytes < (1ull << unit.shift) && unit.shift > 0) continue;
    const double tenths = std::round(std::ldexp(double(bytes), -unit.shift) * 10);
    if (std::fmod(tenths, 10) == 0) return fmt::format("{:.0f} {}", tenths / 10, unit.name);
    return fmt::format("{:.1f} {}", tenths / 10, unit.name);
  }
  return "0 B";
}

std::string bytesExact(std::uint64_t bytes) {
  for (const auto& unit : kUnits) {
    if (unit.shift > 0 && bytes > 0 && bytes % (1ull << unit.shift) == 0) return fmt::format("{}{}", bytes >> unit.shift, unit.name);
  }
  return fmt::format("{}", bytes);
}

}  // namespace welkin
