// Image errors and statistics against numbers worked out by hand; the report's JSON by its promised keys.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "welkin/measure/flip.h"
#include "welkin/measure/image_compare.h"
#include "welkin/measure/statistics.h"
#include "welkin/measure/timings.h"

namespace welkin::measure {
namespace {

Image8 plain(int width, int height, std::uint8_t value) {
  Image8 image{width, height, std::vector<std::uint8_t>(std::size_t(width * height) * 4, value)};
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  return image;
}

TEST(Statistics, quantiles) {
  EXPECT_EQ(quantile({}, 0.5), 0);
  EXPECT_EQ(quantile({3}, 0.95), 3);
  EXPECT_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_EQ(quantile({4, 1, 3, 2}, 1), 4);
  std::vector<double> v;
  for (int i = 0; i <= 100; ++i) v.push_back(100 - i);
  EXPECT_DOUBLE_EQ(quantile(v, 0.95), 95);
  const Summary s = summarize({1, 2, 3, 10});
  EXPECT_EQ(s.n, 4u);
  EXPECT_EQ(s.median, 2.5);
  EXPECT_EQ(s.max, 10);
  EXPECT_EQ(s.mean, 4);
  EXPECT_EQ(s.total, 16);
}

TEST(Compare, equalPictures) {
  const auto e = compare(plain(8, 4, 100), plain(8, 4, 100));
  ASSERT_TRUE(e.ok());
  EXPECT_EQ(e->rmse_255, 0);
  EXPECT_EQ(e->psnr_db, std::numeric_limits<double>::infinity());
  EXPECT_EQ(e->max_255, 0);
}

TEST(Compare, onePixelOfAHundred) {
  Image8 a = plain(10, 10, 100), b = a;
  b.rgba[4 * 55 + 1] = 130;  // one colour of one pixel by 30
  const auto e = compare(a, b);
  ASSERT_TRUE(e.ok());
  EXPECT_DOUBLE_EQ(e->rmse_255, std::sqrt(30.0 * 30 / 300));
  EXPECT_DOUBLE_EQ(e->mean_255, 0.1);
  EXPECT_EQ(e->max_255, 30);
  EXPECT_EQ(e->p99_255, 0);    // 99 of 100 pixels are equal
  EXPECT_EQ(e->p999_255, 30);  // 99.9 % of them needs the last one
  EXPECT_EQ(e->shareOver2, 0.01);
  EXPECT_EQ(e->shareOver16, 0.01);
}

TEST(Compare, alphaDoesNotCount) {
  Image8 a = plain(2, 2, 7), b = a;
  b.rgba[3] = 0;
  EXPECT_EQ(compare(a, b)->max_255, 0);
}

TEST(Compare, sizesMustMatch) {
  EXPECT_EQ(compare(plain(2, 3, 0), plain(3, 2, 0)).error().message, "expected pictures of one size, got 2x3 and 3x2");
  EXPECT_FALSE(compare(Image8{}, Image8{}).ok());
}

TEST(Compare, linearPictures) {
  ImageF a{2, 1, {0.5f, 0.5f, 0.5f, 1, 1, 1, 1, 1}}, b = a;
  b.rgba[0] = 0.25f;
  auto e = compare(a, b);
  ASSERT_TRUE(e.ok());
  EXPECT_DOUBLE_EQ(e->linearRmse, std::sqrt(0.0625 / 6));
  EXPECT_DOUBLE_EQ(e->relativeRmse, std::sqrt(0.0625 / (3 * 0.25 + 3)));
  // sRGB of 0.5 and 0.25 are 187.52 and 136.96 of 255 (IEC 61966-2-1).
  EXPECT_NEAR(e->max_255, 187.516 - 136.958, 0.01);
  EXPECT_EQ(toDisplay(a, 0).rgba[0], 188);
  EXPECT_EQ(toDisplay(a, 1).rgba[0], 255);
  b.rgba[1] = std::numeric_limits<float>::quiet_NaN();
  e = compare(a, b);
  EXPECT_EQ(e->notFinite, 1u);  // counted, and the other pixel is equal
  EXPECT_EQ(e->linearRmse, 0);
}

TEST(Flip, sameIsZeroAndOppositeIsLarge) {
  const auto same = flipDifference(plain(16, 16, 90), plain(16, 16, 90));
  ASSERT_TRUE(same.ok());
  EXPECT_EQ(same->mean, 0);
  const auto opposite = flipDifference(plain(16, 16, 0), plain(16, 16, 255));
  EXPECT_GT(opposite->mean, 0.95);  // black to white is past the knee of the paper's scale
  EXPECT_LE(opposite->mean, 1);
  const auto slight = flipDifference(plain(16, 16, 100), plain(16, 16, 104));
  const auto more = flipDifference(plain(16, 16, 100), plain(16, 16, 120));
  EXPECT_GT(slight->mean, 0);
  EXPECT_LT(slight->mean, more->mean);
  EXPECT_FALSE(flipDifference(plain(2, 2, 0), plain(3, 2, 0)).ok());
}

TEST(Flip, findsWhereItIsAndPaintsIt) {
  Image8 a = plain(32, 32, 100), b = a;
  for (int y = 20; y < 28; ++y) {
    for (int x = 4; x < 12; ++x) b.rgba[std::size_t(4 * (32 * y + x))] = 200;
  }
  const auto flip = flipDifference(a, b);
  ASSERT_TRUE(flip.ok());
  EXPECT_GT(flip->difference[32 * 24 + 8], 0.3f);
  // Filters reach 3 sigma: 0.04 degrees times 67 pixels a degree, about 10 pixels; the far corner is out of it.
  EXPECT_LT(flip->difference[32 * 2 + 30], 1e-6f);
  const Image8 picture = flipPicture(*flip);
  EXPECT_GT(picture.rgba[4 * (32 * 24 + 8)], picture.rgba[4 * (32 * 2 + 30)]);
}

TimingReport report() {
  TimingReport r;
  r.name = "fly/test";
  r.context.glRenderer = "a GPU";
  r.context.software = true;
  r.passOrder = {"bricks", "march", "never"};
  for (int i = 0; i < 4; ++i) {
    FrameRow row;
    row.pathFrame = i;
    row.altitude_m = 1000.0 * i;
    row.stats.passes["march"] = {10.0 + i, 20.0};
    if (i > 1) row.stats.passes["bricks"] = {5, 6};
    row.stats.wall_ms = 20;
    row.stats.exposure_ev = 0.5 * i;
    row.stats.counters.nanPixels = i == 3 ? 2 : 0;
    row.stats.bytesUsed = 1000 + std::uint64_t(i);
    row.stats.bytesBudget = 2000;
    r.frames.push_back(row);
  }
  r.leftOut = {{"sky tables", "no atmosphere", "no-atmosphere"}};
  r.quality = {{1, {}}, {2, {}}};
  r.quality[1].error.rmse_255 = 3;
  r.pops = {{2, 1.5, 0.1, 7}};
  return r;
}

TEST(Timings, jsonHasWhatIsPromised) {
  const auto j = nlohmann::json::parse(report().json());
  EXPECT_EQ(j["context"]["gl_renderer"], "a GPU");
  EXPECT_EQ(j["context"]["software"], true);
  EXPECT_EQ(j["passes"]["march"]["median_ms"], 11.5);
  EXPECT_EQ(j["passes"]["march"]["max_ms"], 13);
  EXPECT_EQ(j["passes"]["march"]["n"], 4);
  EXPECT_EQ(j["passes"]["bricks"]["n"], 2);
  EXPECT_EQ(j["passes"]["march"]["cpu_ms"]["median_ms"], 20);
  EXPECT_FALSE(j["passes"].contains("never"));
  EXPECT_EQ(j["nan_pixels"], 2);
  EXPECT_EQ(j["residency"]["greatest_bytes"], 1003);
  EXPECT_EQ(j["residency"]["budget_kept"], true);
  EXPECT_EQ(j["left_out"][0]["reason"], "no atmosphere");
  EXPECT_EQ(j["quality"]["rmse_255"]["max"], 3);
  EXPECT_EQ(j["pop"]["p999_255"], 1.5);
  EXPECT_EQ(j["pop"]["largest_mean_255"], 0.1);
  EXPECT_EQ(j["frames"].size(), 4u);
  EXPECT_EQ(j["frames"][3]["exposure_ev"], 1.5);
  EXPECT_EQ(j["frames"][2]["passes"]["bricks"]["wall_ms"], 5);
  // As Google Benchmark's own tools read them.
  for (const auto& b : j["benchmarks"]) {
    for (const char* key : {"name", "run_name", "run_type", "iterations", "real_time", "cpu_time", "time_unit"})
      EXPECT_TRUE(b.contains(key)) << key;
  }
  EXPECT_EQ(j["benchmarks"][0]["name"], "fly/test/bricks");
}

TEST(Timings, overTheBudgetIsSeen) {
  TimingReport r = report();
  r.frames[1].stats.bytesUsed = 3000;
  EXPECT_EQ(nlohmann::json::parse(r.json())["residency"]["budget_kept"], false);
}

TEST(Timings, numbersThatAreNotStayJson) {
  TimingReport r = report();
  r.frames[0].stats.wall_ms = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(nlohmann::json::accept(r.json()));
}

TEST(Timings, table) {
  const std::string table = report().table();
  EXPECT_THAT(table, testing::HasSubstr("pass"));
  EXPECT_THAT(table, testing::HasSubstr("11.500"));      // median of march
  EXPECT_THAT(table, testing::HasSubstr("82.1%"));       // 46 of 56 ms
  EXPECT_LT(table.find("bricks"), table.find("march"));  // in the plan's order
}

TEST(Timings, nothingMeasured) {
  TimingReport r;
  EXPECT_TRUE(nlohmann::json::accept(r.json()));
  EXPECT_FALSE(r.table().empty());
}

}  // namespace
}  // namespace welkin::measure
