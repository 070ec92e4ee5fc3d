#pragma once
#include <cstdint>

namespace welkin {

// The least code whose value (shared::maxCodeValue) is at least `fraction`, a fraction of the source's greatest extinction: rounds
// up, so skipping by it is conservative. 0 only for fraction <= 0; over 1 is taken as 1.
std::uint32_t maxCodeFor(float fraction);

}  // namespace welkin
