#include "welkin/app/flight_result.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "run_program.h"
#include "welkin/app/restore.h"
#include "welkin/core/files.h"
#include "welkin/measure/timings.h"

namespace welkin::app {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

// Frames of 10, 11, ... ms, `factor` times as long; two passes.
measure::TimingReport report(double factor, int frames = 101) {
  measure::TimingReport r;
  r.context.width = 320, r.context.height = 180, r.context.step = 0.32, r.context.integrator = "exponential-linear";
  r.context.scene = "earth.json", r.context.glRenderer = "software";
  r.passOrder = {"sky", "march"};
  for (int i = 0; i < frames; ++i) {
    measure::FrameRow row;
    row.pathFrame = i;
    row.stats.wall_ms = factor * (10 + i);
    row.stats.passes["march"].wall_ms = factor * 8;
    row.stats.passes["sky"].wall_ms = factor * 2;
    row.stats.wait_ms = 1;
    row.stats.bytesUsed = 100 << 20;
    r.frames.push_back(row);
  }
  return r;
}
FlightResult read(const measure::TimingReport& r) {
  auto result = parseFlightResult(r.json(), "r.json");
  EXPECT_TRUE(result.ok()) << result.error().message;
  return *result;
}
const ComparedRow* row(const ResultComparison& c, const std::string& name) {
  for (const auto& r : c.rows)
    if (r.name == name) return &r;
  return nullptr;
}

TEST(FlightResult, ReadsWhatFlyWrites) {
  const FlightResult r = read(report(1));
  EXPECT_EQ(r.frame_ms.size(), 101u);
  EXPECT_EQ(r.median_ms, 60);
  EXPECT_EQ(r.p95_ms, 105);
  EXPECT_EQ(r.p99_ms, 109);
  EXPECT_EQ(r.max_ms, 110);
  ASSERT_EQ(r.passes_ms.size(), 2u);
  EXPECT_EQ(r.passes_ms[0], std::pair(std::string("sky"), 2.0));  // in the order in which they run
  EXPECT_EQ(r.wait_ms, 101);
  EXPECT_EQ(r.greatestBytes, 100 << 20);
  EXPECT_FALSE(r.rmse_255);
  EXPECT_THAT(r.settings, testing::Contains(std::pair(std::string("size"), std::string("320x180"))));
}

TEST(FlightResult, SideBySide) {
  auto other = report(2, 50);
  other.context.step = 0.16, other.context.seed = 3;
  other.frames.back().stats.counters.nanPixels = 4;
  for (auto& frame : other.frames) frame.stats.passes["light"].wall_ms = 5;
  const ResultComparison c = compareResults(read(report(1)), read(other));
  EXPECT_NEAR(*row(c, "sky")->ratio, 2, 1e-12);
  EXPECT_NEAR(*row(c, "frames a second")->ratio, 60 / 69.0, 1e-12);  // medians: 60 ms, and 2 * (10 + 24.5) ms
  EXPECT_FALSE(row(c, "light")->a);
  EXPECT_EQ(*row(c, "light")->b, 5);
  EXPECT_FALSE(row(c, "light")->ratio);
  EXPECT_EQ(*row(c, "not a number")->b, 4);
  EXPECT_EQ(*row(c, "frames")->a, 101);
  std::vector<std::string> names;
  for (const auto& d : c.different) names.push_back(d.name + " " + d.a + " " + d.b);
  EXPECT_THAT(names, testing::UnorderedElementsAre("step 0.32 0.16", "seed 0 3"));
  const std::string text = comparisonText(c);
  EXPECT_THAT(text, HasSubstr("B / A"));
  EXPECT_THAT(text, HasSubstr("2.000  ms\n"));
  EXPECT_THAT(text, HasSubstr("  step  A 0.32\n        B 0.16\n"));
  EXPECT_THAT(comparisonText(compareResults(read(report(1)), read(report(1)))), HasSubstr("same settings"));
}

TEST(FlightResult, WrongFilesAreOneLine) {
  const Json good = Json::parse(report(1, 3).json());
  const auto changed = [&](const char* pointer, Json value) {
    Json other = good;
    other[Json::json_pointer(pointer)] = std::move(value);
    return other.dump();
  };
  Json without = good;
  without.erase("frame_ms");
  const std::string bad[] = {"",
                             "{",
                             "[]",
                             "{}",
                             "null",
                             without.dump(),
                             changed("/frames", Json::array()),
                             changed("/frames", 3),
                             changed("/frames/1/wall_ms", "slow"),
                             changed("/frames/1/wall_ms", -1),
                             changed("/frames/0", 5),
                             changed("/passes", {1, 2}),
                             changed("/passes/sky/median_ms", nullptr),
                             changed("/context", 1),
                             changed("/context/settings", {1}),
                             changed("/context/settings/step", {1}),
                             changed("/nan_pixels", "none"),
                             changed("/quality", {{"rmse_255", {{"median", "x"}}}})};
  for (const auto& text : bad) {
    const auto result = parseFlightResult(text, "r.json");
    ASSERT_FALSE(result.ok()) << text.substr(0, 80);
    EXPECT_THAT(result.error().message,
                testing::AnyOf(testing::StartsWith("r.json: expected"), testing::MatchesRegex("r.json: /.*: expected .*")))
        << text.substr(0, 80);
    EXPECT_EQ(result.error().message.find('\n'), std::string::npos);
  }
}

// Whatever a byte becomes: an error or a result, no crash.
TEST(FlightResult, CutAndFlippedAnywhere) {
  const std::string whole = report(1, 2).json();
  int good = 0;
  for (std::size_t i = 0; i < whole.size(); i += 3) {
    EXPECT_FALSE(parseFlightResult(whole.substr(0, i), "cut").ok()) << i;
    std::string flipped = whole;
    flipped[i] = char(flipped[i] ^ (1 << (i % 8)));
    good += parseFlightResult(flipped, "flipped").ok();
  }
  EXPECT_GT(good, 0);  // a letter of the context
}

struct ResultFiles : testing::Test {
  fs::path folder = fs::temp_directory_path() / ("welkin_result_test_" + std::to_string(::getpid()));
  void SetUp() override {
    fs::create_directories(folder);
    ASSERT_TRUE(writeFile(folder / "a.json", report(1).json()).ok());
    ASSERT_TRUE(writeFile(folder / "b.json", report(0.5).json()).ok());
  }
  void TearDown() override { fs::remove_all(folder); }
  std::string name(const char* file) const { return (folder / file).string(); }
};

TEST_F(ResultFiles, CompareCommand) {
  const auto same = test::run({"compare", name("a.json").c_str(), name("b.json").c_str(), "--json", name("c.json").c_str()});
  EXPECT_EQ(same.exit, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr("frame, median"));
  const auto json = Json::parse(*readFile(folder / "c.json"));
  EXPECT_EQ(json["rows"][0]["b_over_a"], 0.5);
  EXPECT_TRUE(json["different"].empty());
  ASSERT_TRUE(writeFile(folder / "no.json", "{\"planet\": {}}").ok());
  const auto mixed = test::run({"compare", name("a.json").c_str(), name("no.json").c_str()});
  EXPECT_EQ(mixed.exit, 1);
  EXPECT_THAT(mixed.err, HasSubstr("no.json: expected the key"));
  EXPECT_EQ(test::run({"compare", name("a.json").c_str(), name("b.json").c_str(), "-o", name("d.png").c_str()}).exit, 1);
}

TEST_F(ResultFiles, ADroppedResultIsKnown) {
  EXPECT_TRUE(isFlightResult(folder / "a.json"));
  const auto restored = restoreFrom(folder / "a.json");
  ASSERT_TRUE(restored.ok()) << restored.error().message;
  EXPECT_EQ(restored->kind, RestoredKind::FlightResult);
  ASSERT_TRUE(restored->result.has_value());
  EXPECT_EQ(restored->result->median_ms, 60);
  EXPECT_FALSE(isFlightResult(folder / "none.json"));
}

}  // namespace
}  // namespace welkin::app
