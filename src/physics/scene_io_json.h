#pragma once
// Reading JSON with a place for every complaint. Inside src/physics only: nlohmann-json stays out of public headers.
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "welkin/core/result.h"
#include "welkin/physics/scene.h"

namespace welkin::detail {

// Thrown inside the readers, caught at their public border.
struct InputError {
  std::string message;
};

// Text to a value: syntax errors with line and column, numbers too large and repeated keys with their JSON pointer.
nlohmann::json parseJson(std::string_view text, const std::string& sourceName);

struct Range {
  double low = -std::numeric_limits<double>::max(), high = std::numeric_limits<double>::max();
  bool lowOpen = false, highOpen = false;  // the end itself is not allowed
};
constexpr Range above(double low, double high) { return {low, high, true, false}; }

// A value and where it stands. Every reader throws InputError when the value is not what was expected.
class JsonPlace {
 public:
  JsonPlace(const nlohmann::json& value, const std::string& sourceName, std::string pointer = {})
      : value_(&value), source_(&sourceName), pointer_(std::move(pointer)) {}

  // An object with no keys but these.
  void object(std::initializer_list<std::string_view> keys) const;
  bool has(std::string_view key) const { return value_->is_object() && value_->contains(key); }
  JsonPlace at(std::string_view key) const;  // must be there
  JsonPlace item(std::size_t index) const;
  std::size_t array(std::size_t least, std::size_t most) const;  // its size
  std::vector<std::string> keys() const;                         // of any object

  double number(Range range) const;
  std::int64_t integer(std::int64_t low, std::int64_t high) const;
  std::string text(std::size_t least = 1, std::size_t most = 4096) const;
  std::string choice(std::initializer_list<std::string_view> allowed) const;
  std::size_t choice(std::span<const char* const> names) const;  // which of them
  bool boolean() const;
  template <int N>
  std::array<double, N> numbers(Range range) const {
    array(N, N);
    std::array<double, N> out;
    for (int i = 0; i < N; ++i) out[i] = item(std::size_t(i)).number(range);
    return out;
  }
  Spectrum3 spectrum(Range range) const { return numbers<3>(range); }
  glm::dvec3 vec3(Range range) const;
  glm::dvec3 unitVec3() const;     // any length but 0, normalised unless it already is
  glm::dquat orientation() const;  // x y z w
  double numberOr(std::string_view key, double otherwise, Range range) const { return has(key) ? at(key).number(range) : otherwise; }

  const nlohmann::json& value() const { return *value_; }
  [[noreturn]] void fail(const std::string& expected) const;  // "FILE: POINTER: expected EXPECTED, got VALUE"
  [[noreturn]] void failPlain(const std::string& message) const;

 private:
  const nlohmann::json* value_;
  const std::string* source_;
  std::string pointer_;
};

// A view in geographic or explicit form.
View readView(const JsonPlace& place, double planetRadius_m);
nlohmann::ordered_json writeView(const View& view);

// Is the position on or above the ground? Rounding of (R + h) n and of its length costs a few units in the last place.
bool aboveGround(glm::dvec3 position_m, double planetRadius_m);

constexpr double kFarthest_m = 1e12;  // of any position: past the planets
constexpr Range kFovRange_deg{0.0001, 179.9};
constexpr Range kExposureRange_ev{-40, 40};

}  // namespace welkin::detail
