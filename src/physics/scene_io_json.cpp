#include "scene_io_json.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "welkin/core/files.h"

namespace welkin::detail {
namespace {

using nlohmann::json;

std::string escaped(std::string_view key) {  // RFC 6901
  std::string out;
  for (const char c : key) out += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
  return out;
}

std::string shown(const std::string& pointer) { return pointer.empty() ? "the whole file" : oneLine(pointer, 300); }

std::string shown(const json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return fmt::format("a list of {}", value.size());
  return oneLine(value.dump(-1, ' ', false, json::error_handler_t::replace), 60);
}

std::string joined(std::initializer_list<std::string_view> words) {
  std::string out;
  for (const auto word : words) out += (out.empty() ? "" : ", ") + std::string(word);
  return out;
}

// Follows the text, knows at every moment where it is, and stops at the first thing that a parsed value would hide.
class Checker : public json::json_sax_t {
 public:
  Checker(std::string_view text, const std::string& source) : text_(text), source_(source) {}

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return open(false); }
  bool start_array(std::size_t) override { return open(true); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    levels_.back().key = name;
    if (!levels_.back().seen.insert(name).second)
      throw InputError{fmt::format("{}: {}: this key is given twice", source_, shown(pointer()))};
    return true;
  }
  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception& ex) override {
    if (ex.id == 406)
      throw InputError{fmt::format("{}: {}: expected a number that a double holds, got {}", source_, shown(pointer()), oneLine(token, 60))};
    std::size_t line = 1, column = 1;
    for (std::size_t i = 0; i + 1 < position && i < text_.size(); ++i) {
      ++column;
      if (text_[i] == '\n') ++line, column = 1;
    }
    std::string why = ex.what();  // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while parsing ..."
    if (const auto at = why.find(": "); at != std::string::npos) why = why.substr(at + 2);
    throw InputError{fmt::format("{}: line {}, column {}: expected JSON: {}", source_, line, column, oneLine(why))};
  }

 private:
  struct Level {
    bool isArray;
    std::size_t index = 0;
    std::string key;
    std::set<std::string> seen;
  };
  bool open(bool isArray) {
    // Deeper than any scene; keeps the pointer short and what follows from recursing far.
    if (levels_.size() >= 64) throw InputError{fmt::format("{}: {}: expected at most 64 levels of nesting", source_, shown(pointer()))};
    levels_.push_back({isArray, 0, {}, {}});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return value();
  }
  bool value() {
    if (!levels_.empty() && levels_.back().isArray) ++levels_.back().index;
    return true;
  }
  std::string pointer() const {
    std::string out;
    for (const auto& level : levels_) out += "/" + (level.isArray ? std::to_string(level.index) : escaped(level.key));
    return out;
  }

  std::string_view text_;
  const std::string& source_;
  std::vector<Level> levels_;
};

}  // namespace

json parseJson(std::string_view text, const std::string& sourceName) {
  if (text.empty()) throw InputError{fmt::format("{}: line 1, column 1: expected JSON, the file is empty", sourceName)};
  Checker checker(text, sourceName);
  json::sax_parse(text, &checker);
  return json::parse(text);
}

void JsonPlace::fail(const std::string& expected) const {
  throw InputError{fmt::format("{}: {}: expected {}, got {}", *source_, shown(pointer_), expected, shown(*value_))};
}

void JsonPlace::failPlain(const std::string& message) const {
  throw InputError{fmt::format("{}: {}: {}", *source_, shown(pointer_), message)};
}

void JsonPlace::object(std::initializer_list<std::string_view> allowed) const {
  if (!value_->is_object()) fail("an object");
  for (const auto& entry : value_->items()) {
    if (std::find(allowed.begin(), allowed.end(), entry.key()) != allowed.end()) continue;
    const JsonPlace wrong(entry.value(), *source_, pointer_ + "/" + escaped(entry.key()));
    wrong.failPlain("unknown key, expected one of: " + joined(allowed));
  }
}

JsonPlace JsonPlace::at(std::string_view key) const {
  if (!has(key)) failPlain(fmt::format("expected the key \"{}\", it is missing", key));
  return {value_->at(std::string(key)), *source_, pointer_ + "/" + escaped(key)};
}

JsonPlace JsonPlace::item(std::size_t index) const { return {value_->at(index), *source_, pointer_ + "/" + std::to_string(index)}; }

std::size_t JsonPlace::array(std::size_t least, std::size_t most) const {
  const std::string wanted = least == most ? fmt::format("a list of {}", least) : fmt::format("a list of {} to {}", least, most);
  if (!value_->is_array() || value_->size() < least || value_->size() > most) fail(wanted);
  return value_->size();
}

std::vector<std::string> JsonPlace::keys() const {
  if (!value_->is_object()) fail("an object");
  std::vector<std::string> out;
  for (const auto& entry : value_->items()) out.push_back(entry.key());
  return out;
}

double JsonPlace::number(Range range) const {
  std::string wanted = "a number";
  if (range.high < std::numeric_limits<double>::max()) {
    const bool open = range.lowOpen || range.highOpen;
    wanted += fmt::format(" {} {} {}{} {}", range.lowOpen ? "over" : "from", range.low, open ? "and " : "",
                          range.highOpen ? "under"
                          : open         ? "up to"
                                         : "to",
                          range.high);
  }
  if (!value_->is_number()) fail(wanted);
  const double v = value_->get<double>();
  const bool low = range.lowOpen ? v > range.low : v >= range.low;
  const bool high = range.highOpen ? v < range.high : v <= range.high;
  if (!low || !high || !std::isfinite(v)) fail(wanted);
  return v;
}

std::int64_t JsonPlace::integer(std::int64_t low, std::int64_t high) const {
  const std::string wanted = fmt::format("a whole number from {} to {}", low, high);
  if (!value_->is_number_integer()) fail(wanted);
  // Above the range of int64 nlohmann keeps unsigned values.
  if (value_->is_number_unsigned() && value_->get<std::uint64_t>() > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
    fail(wanted);
  const auto v = value_->get<std::int64_t>();
  if (v < low || v > high) fail(wanted);
  return v;
}

std::string JsonPlace::text(std::size_t least, std::size_t most) const {
  const std::string wanted = fmt::format("a text of {} to {} bytes", least, most);
  if (!value_->is_string()) fail(wanted);
  auto out = value_->get<std::string>();
  if (out.size() < least || out.size() > most || out.find('\0') != std::string::npos) fail(wanted);
  return out;
}

std::string JsonPlace::choice(std::initializer_list<std::string_view> allowed) const {
  const std::string wanted = "one of: " + joined(allowed);
  if (!value_->is_string()) fail(wanted);
  const auto out = value_->get<std::string>();
  if (std::find(allowed.begin(), allowed.end(), out) == allowed.end()) fail(wanted);
  return out;
}

std::size_t JsonPlace::choice(std::span<const char* const> names) const {
  const auto found = value_->is_string() ? std::find(names.begin(), names.end(), value_->get<std::string>()) : names.end();
  if (found == names.end()) fail(fmt::format("one of: {}", fmt::join(names, ", ")));
  return std::size_t(found - names.begin());
}

bool JsonPlace::boolean() const {
  if (!value_->is_boolean()) fail("true or false");
  return value_->get<bool>();
}

glm::dvec3 JsonPlace::vec3(Range range) const {
  const auto v = numbers<3>(range);
  return {v[0], v[1], v[2]};
}

// A value that was already normalised must come back bit for bit, or a picture's state would drift at every round trip.
constexpr double kUnitSquareError = 8 * std::numeric_limits<double>::epsilon();

glm::dvec3 JsonPlace::unitVec3() const {
  const glm::dvec3 v = vec3({-1e150, 1e150});  // squares stay finite
  const double square = glm::dot(v, v);
  if (!(square > 1e-300)) fail("a direction that is not zero");
  return std::abs(square - 1) <= kUnitSquareError ? v : v / std::sqrt(square);
}

glm::dquat JsonPlace::orientation() const {
  const auto v = numbers<4>({-2, 2});
  const double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3];
  // People write quaternions with three digits: 2e-3 in the length, 4e-3 in its square. Farther off it is a mistake.
  if (std::abs(square - 1) > 4e-3) fail("a unit quaternion x, y, z, w");
  const double s = std::abs(square - 1) <= kUnitSquareError ? 1 : 1 / std::sqrt(square);
  return glm::dquat(v[3] * s, v[0] * s, v[1] * s, v[2] * s);
}

}  // namespace welkin::detail
