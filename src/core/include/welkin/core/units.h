#pragma once
// Amounts of memory as people write them.
#include <cstdint>
#include <string>
#include <string_view>

#include "welkin/core/result.h"

namespace welkin {

// "512MiB", "4 GiB", "1.5GiB", "64KiB" or plain bytes. The error says what was expected, not where.
Result<std::uint64_t> parseBytes(std::string_view text);
// "512 MiB", "1.5 GiB", "700 B": at most one decimal.
std::string bytesText(std::uint64_t bytes);
// Exact and readable by parseBytes: "512MiB" if it is a whole number of them, else plain bytes.
std::string bytesExact(std::uint64_t bytes);

}  // namespace welkin
