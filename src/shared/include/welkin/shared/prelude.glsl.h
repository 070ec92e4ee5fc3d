#pragma once
// What lets one file be GLSL 4.50 and C++20 at once. In both: scalars and vectors by value, struct returns, F(1.0) literals.
#ifdef __cplusplus
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/integer.hpp>
namespace welkin::shared {
using uint = std::uint32_t;
using glm::abs, glm::ceil, glm::clamp, glm::cross, glm::dot, glm::exp, glm::exp2, glm::findMSB, glm::floor, glm::inversesqrt, glm::length,
    glm::log, glm::log2, glm::max, glm::min, glm::mix, glm::normalize, glm::pow, glm::sign, glm::sqrt, glm::step;
using glm::ivec2, glm::ivec3, glm::ivec4, glm::uvec2, glm::uvec3, glm::uvec4, glm::vec2, glm::vec3, glm::vec4, glm::mat3, glm::bvec3;
inline std::uint32_t floatBitsToUint(float x) { std::uint32_t u; __builtin_memcpy(&u, &x, 4); return u; }
constexpr float F(double literal) { return static_cast<float>(literal); }  // a function, not a macro: libraries use the letter
inline float uintBitsToFloat(std::uint32_t u) { float x; __builtin_memcpy(&x, &u, 4); return x; }
}  // namespace welkin::shared
#define WK_BEGIN namespace welkin::shared {
#define WK_END }
#define WK_FN inline
#define WK_CONST inline constexpr
#define WK_NEW(type, ...) type{__VA_ARGS__}  // construct a struct; GLSL has no variadic macros: its loader writes type(...)
#else
#define WK_BEGIN
#define WK_END
#define WK_FN
#define WK_CONST const
#define F(x) (x)
#endif
