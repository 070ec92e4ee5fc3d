// Error against time: pictures, fronts and orders that are worked out by hand; the report by its promised keys.
#include "welkin/measure/converge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace welkin::measure {
namespace {
using testing::ElementsAre, testing::HasSubstr, testing::Not;

ConvergeRow row(const std::string& name, double time_ms, double rmse_255, double step = 0.32) {
  ConvergeRow r;
  r.setting.name = name;
  r.setting.series = {"a line"};
  r.setting.quality.step = step;
  r.time_ms = {time_ms, time_ms, time_ms, 1};
  r.error.rmse_255 = rmse_255;
  return r;
}

TEST(Spread, medianAndQuartiles) {
  const Spread s = spreadOf({5, 1, 2, 4, 3});
  EXPECT_EQ(s.median, 3);
  EXPECT_EQ(s.p25, 2);
  EXPECT_EQ(s.p75, 4);
  EXPECT_EQ(s.n, 5u);
}

TEST(CompareShown, throughExposureAndToneCurve) {
  // Reinhard's curve of grey y = 8 x (base exposure 8, EV 0): y (1 + y / 16) / (1 + y). x = 1/8: 17/32; x = 1/16: 0.5 * 1.03125 / 1.5 =
  // 0.34375. Their sRGB values (IEC 61966-2-1): 0.755096 and 0.621914 of 255.
  const ImageF first{1, 1, {0.125f, 0.125f, 0.125f, 1}}, second{1, 1, {0.0625f, 0.0625f, 0.0625f, 1}};
  const auto shown = [](double v) { return 255 * (1.055 * std::pow(v, 1 / 2.4) - 0.055); };
  const double expected = shown(17.0 / 32) - shown(0.34375);
  const auto e = compareShown(first, second, ToneCurve::Reinhard, 0);
  ASSERT_TRUE(e.ok());
  EXPECT_NEAR(e->rmse_255, expected, 2e-4);  // floats in the curve: 6e-8 of 1, times 255 and the slope of sRGB
  EXPECT_NEAR(e->max_255, expected, 2e-4);
  EXPECT_EQ(e->shareOver2, 1);
  EXPECT_NEAR(e->relativeRmse, 0.5, 1e-12);  // of the first
  EXPECT_NEAR(shownDifference(first, second, ToneCurve::Reinhard, 0)[0], expected, 2e-4);
  // One stop brighter, the second is as the first was.
  EXPECT_NEAR(compareShown(second, first, ToneCurve::Reinhard, 1)->max_255, shown(2 * 1.125 / 3) - shown(17.0 / 32), 2e-4);
}

TEST(CompareShown, differencesFarBelowARoundingStepCount) {
  const ImageF first{1, 1, {0.1f, 0.1f, 0.1f, 1}}, second{1, 1, {0.10001f, 0.1f, 0.1f, 1}};
  const auto e = compareShown(first, second, ToneCurve::Reinhard, 0);
  EXPECT_GT(e->rmse_255, 0);
  EXPECT_LT(e->rmse_255, 0.01);
}

TEST(Joined, squaresAreAveragedAndGreatestKept) {
  ImageError a, b;
  a.rmse_255 = 3, b.rmse_255 = 4, a.max_255 = 9, b.max_255 = 7, a.shareOver2 = 0.1, b.shareOver2 = 0.3;
  const ImageError all = joined({a, b});
  EXPECT_DOUBLE_EQ(all.rmse_255, std::sqrt(12.5));
  EXPECT_EQ(all.max_255, 9);
  EXPECT_DOUBLE_EQ(all.shareOver2, 0.2);
  EXPECT_EQ(joined({}).rmse_255, 0);
}

TEST(Pareto, aMadeUpList) {
  const std::vector<ConvergeRow> rows{row("slow and fine", 9, 0.1),    row("beaten", 5, 3),
                                      row("fast and coarse", 1, 4),    row("middle", 4, 1),
                                      row("as middle", 4, 1),          row("slower, no better", 6, 1),
                                      row("broken", 0.5, std::nan(""))};
  EXPECT_THAT(paretoFront(rows), ElementsAre("fast and coarse", "middle", "slow and fine"));
  EXPECT_TRUE(paretoFront({}).empty());
}

TEST(LogSlope, powersAndNothing) {
  EXPECT_NEAR(*logSlope({1, 2, 4}, {3, 24, 192}), 3, 1e-12);
  EXPECT_FALSE(logSlope({1}, {1}));
  EXPECT_FALSE(logSlope({2, 2}, {1, 3}));  // upright
  EXPECT_FALSE(logSlope({1, 2}, {0, 1}));
}

TEST(Orders, ofMadeUpErrors) {
  std::vector<ConvergeRow> rows;
  for (const double step : {0.1, 0.8, 0.4, 0.2}) rows.push_back(row("step", 1, 5 * step * step, step));
  auto orders = observedOrders(rows, 0);
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_NEAR(orders[0].order, 2, 1e-12);
  EXPECT_EQ(orders[0].points, 4);
  // The finest is nearer to the truth than thrice its tolerance: 0.05 < 3 * 0.02. Whatever it says is left out.
  rows[0].error.rmse_255 = 0.04;
  orders = observedOrders(rows, 0.02);
  ASSERT_EQ(orders.size(), 1u);
  EXPECT_NEAR(orders[0].order, 2, 1e-12);
  EXPECT_EQ(orders[0].points, 3);
  EXPECT_TRUE(observedOrders(rows, 1).empty());  // nothing stands clear of the truth
  rows[1].setting.quality.budget_bytes *= 2;     // not only the step changes
  EXPECT_TRUE(observedOrders(rows, 0.02).empty());
}

ConvergeReport report() {
  ConvergeReport r;
  for (const double step : {0.8, 0.4, 0.2, 0.1}) {
    r.rows.push_back(row("rule " + std::to_string(step), 1 / step, 2 * step, step));
    r.rows.back().passes_ms["march"] = {0.9 / step, 0.8 / step, 1 / step, 3};
  }
  r.rows[0].setting.name = "a <b> & \"c\"";
  r.truth = {"gpu", "the finest", 0.01};
  r.view = "near";
  r.pictures = {{"truth", "all", "\x89PNG"}};
  r.tables = {{"as published", {"step 0.1"}, {"8 GiB"}, {{{1, 2, 3.5, "all of it"}}}}};
  return r;
}

TEST(Report, jsonHasWhatIsPromised) {
  const auto j = nlohmann::json::parse(report().json());
  EXPECT_EQ(j["truth"]["kind"], "gpu");
  EXPECT_EQ(j["truth"]["tolerance"], 0.01);
  EXPECT_EQ(j["context"]["view"], "near");
  ASSERT_EQ(j["settings"].size(), 4u);
  for (const char* key : {"name", "integrator", "step_rule", "step", "budget_bytes", "depth", "detail", "frames", "time_ms",
                          "time_spread_ms", "passes", "bytes", "samples", "cells", "residency", "error"})
    EXPECT_TRUE(j["settings"][0].contains(key)) << key;
  for (const char* key : {"rmse_255", "relative_rmse", "p99_255", "max_255", "over_2_share", "flip", "not_finite"})
    EXPECT_TRUE(j["settings"][0]["error"].contains(key)) << key;
  EXPECT_EQ(j["settings"][1]["passes"]["march"]["n"], 3);
  EXPECT_EQ(j["pareto"].size(), 4u);
  EXPECT_NEAR(j["orders"][0]["observed_order"].get<double>(), 1, 1e-12);
  EXPECT_EQ(j["orders"][0]["integrator"], "exponential-linear");
  EXPECT_EQ(j["tables"][0]["cells"][0]["truth_rmse_255"], 3.5);
}

TEST(Report, htmlStandsAlone) {
  const std::string html = report().html();
  EXPECT_THAT(html, Not(HasSubstr("http")));
  EXPECT_THAT(html, Not(HasSubstr("@import")));
  EXPECT_THAT(html, Not(HasSubstr("url(")));
  EXPECT_THAT(html, HasSubstr("prefers-color-scheme: dark"));
  for (std::size_t at = html.find("src="); at != std::string::npos; at = html.find("src=", at + 1))
    EXPECT_EQ(html.substr(at, 10), "src=\"data:");
  EXPECT_THAT(html, HasSubstr("base64,iVBORw=="));  // of "\x89PNG", by RFC 4648
  EXPECT_THAT(html, HasSubstr("a &lt;b&gt; &amp; &quot;c&quot;"));
  EXPECT_THAT(html, Not(HasSubstr("a <b>")));
  EXPECT_THAT(html, HasSubstr("order 1.00"));
  EXPECT_THAT(html, HasSubstr("all of it"));
}

TEST(Report, emptyOnesAreNoTrouble) {
  ConvergeReport r;
  EXPECT_THAT(r.html(), HasSubstr("Nothing to plot"));
  EXPECT_TRUE(nlohmann::json::parse(r.json())["pareto"].empty());
  r.rows = {row("the truth itself", 1, 0)};
  EXPECT_THAT(r.html(), HasSubstr("Nothing to plot"));
}

}  // namespace
}  // namespace welkin::measure
