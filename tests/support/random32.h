#pragma once
#include <cstdint>
#include <random>

namespace welkin::test {

// std::mt19937 with results of 32 bits (its own are as wide as the platform likes): same numbers.
using Random32 = std::mersenne_twister_engine<std::uint32_t, 32, 624, 397, 31, 0x9908b0dfu, 11, 0xffffffffu, 7, 0x9d2c5680u, 15,
                                              0xefc60000u, 18, 1812433253u>;

}  // namespace welkin::test
