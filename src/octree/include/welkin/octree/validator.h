#pragma once
#include <string>

#include "welkin/octree/tree.h"

namespace welkin {

// Checks every invariant of tree and pools: links, addresses, ownership, counters, publication, both kinds of bounds. Empty if sound,
// else the first thing wrong, in one line. maxExtinction_per_m > 0 also holds resident bounds against source bounds.
std::string validateTree(const Tree& tree, float maxExtinction_per_m = 0);

}  // namespace welkin
