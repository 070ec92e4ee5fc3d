// docs/scene.schema.json and the reader say the same: what one accepts or rejects, the other does too.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "scene_io_support.h"
#include "welkin/core/files.h"
#include "welkin/physics/scene_io.h"

namespace welkin {
namespace {

using nlohmann::json;
using testing_support::kFullScene;

// The part of JSON Schema that the file uses; any other keyword fails the test.
bool valid(const json& schema, const json& v) {
  for (const auto& rule : schema.items()) {
    const std::string& k = rule.key();
    const json& r = rule.value();
    const bool number = v.is_number();
    bool ok = true;
    if (k == "type") {
      ok = r == "object"    ? v.is_object()
           : r == "array"   ? v.is_array()
           : r == "string"  ? v.is_string()
           : r == "integer" ? v.is_number_integer()
           : r == "boolean" ? v.is_boolean()
                            : number;
    } else if (k == "const") {
      ok = v == r;
    } else if (k == "enum") {
      ok = std::find(r.begin(), r.end(), v) != r.end();
    } else if (k == "minimum") {
      ok = !number || v.get<double>() >= r.get<double>();
    } else if (k == "maximum") {
      ok = !number || v.get<double>() <= r.get<double>();
    } else if (k == "exclusiveMinimum") {
      ok = !number || v.get<double>() > r.get<double>();
    } else if (k == "minItems") {
      ok = !v.is_array() || v.size() >= r.get<std::size_t>();
    } else if (k == "maxItems") {
      ok = !v.is_array() || v.size() <= r.get<std::size_t>();
    } else if (k == "minLength") {
      ok = !v.is_string() || v.get<std::string>().size() >= r.get<std::size_t>();
    } else if (k == "maxLength") {
      ok = !v.is_string() || v.get<std::string>().size() <= r.get<std::size_t>();
    } else if (k == "items") {
      for (const auto& item : v) ok = ok && (!v.is_array() || valid(r, item));
    } else if (k == "required") {
      for (const auto& key : r) ok = ok && (!v.is_object() || v.contains(key.get<std::string>()));
    } else if (k == "oneOf") {
      ok = std::count_if(r.begin(), r.end(), [&](const json& one) { return valid(one, v); }) == 1;
    } else if (k == "additionalProperties") {
      const json known = schema.value("properties", json::object());
      for (const auto& entry : v.items()) {
        if (v.is_object() && !known.contains(entry.key()))
          ok = ok && !(r.is_boolean() && !r.get<bool>()) && (r.is_boolean() || valid(r, entry.value()));
      }
    } else if (k == "properties") {
      for (const auto& entry : r.items()) {
        if (v.is_object() && v.contains(entry.key())) ok = ok && valid(entry.value(), v[entry.key()]);
      }
    } else {
      EXPECT_TRUE(k == "$schema" || k == "title" || k == "description") << "keyword " << k;
    }
    if (!ok) return false;
  }
  return true;
}

json schema() { return json::parse(*readFile(std::filesystem::path(WELKIN_SOURCE_DIR) / "docs" / "scene.schema.json")); }

TEST(SceneSchema, acceptsWhatIsReadAndWritten) {
  EXPECT_TRUE(valid(schema(), json::parse(kFullScene)));
  EXPECT_TRUE(valid(schema(), json::parse(sceneToJson(*parseScene(kFullScene, "test.json")))));
  EXPECT_TRUE(valid(schema(), json::object()));
}

TEST(SceneSchema, acceptsTheScenesOfTheRepository) {
  int n = 0;
  for (const char* folder : {"scenes", "benchmarks", "benchmarks/left-out", "benchmarks/poses"}) {
    const auto where = std::filesystem::path(WELKIN_SOURCE_DIR) / folder;
    if (!std::filesystem::is_directory(where)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(where)) {
      if (entry.path().extension() != ".json") continue;
      const json value = json::parse(*readFile(entry.path()));
      if (value.contains("frames")) continue;  // a path
      EXPECT_TRUE(valid(schema(), value)) << entry.path();
      const auto scene = loadScene(entry.path());
      EXPECT_TRUE(scene.ok()) << (scene.ok() ? "" : scene.error().message);
      ++n;
    }
  }
  EXPECT_GE(n, 1);
}

// Every leaf of the full scene, replaced by values of the wrong kind or out of range, and removed.
TEST(SceneSchema, rejectsTogetherWithTheReader) {
  const json whole = json::parse(kFullScene), rules = schema(), flat = whole.flatten();
  const json tries[] = {
      nullptr, true, "text", "", -1, -1e13, 0, 0.5, 1e13, 1e200, 17, 100000, json::array(), json::object(), json::array({1, 2})};
  int rejected = 0, accepted = 0;
  for (const auto& leaf : flat.items()) {
    for (const auto& value : tries) {
      json changed = whole;
      changed[json::json_pointer(leaf.key())] = value;
      const auto scene = parseScene(changed.dump(), "test.json");
      const bool byRules = valid(rules, changed);
      // The reader knows more than a schema can say: tops over bases, unit vectors, positions above the ground, amounts of memory, texts.
      if (scene.ok() && !byRules) ADD_FAILURE() << "the reader accepts, the schema does not: " << leaf.key() << " = " << value;
      (scene.ok() ? accepted : rejected)++;
    }
  }
  EXPECT_GT(rejected, 1000);
  EXPECT_GT(accepted, 50);
}

TEST(SceneSchema, everyKeyOfTheReaderIsThere) {
  json whole = json::parse(kFullScene);
  const json rules = schema();
  for (const auto& section : rules["properties"].items()) {
    if (section.key() == "$schema") continue;
    EXPECT_TRUE(whole.contains(section.key())) << section.key();
    if (!section.value().contains("properties") || section.key() == "sun") continue;
    for (const auto& key : section.value()["properties"].items())
      EXPECT_TRUE(whole[section.key()].contains(key.key())) << section.key() << "/" << key.key();
  }
}

}  // namespace
}  // namespace welkin
