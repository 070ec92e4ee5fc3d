// Which settings a sweep is made of, and wrong usage of `welkin converge`; nothing here draws.
#include "welkin/app/converge.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "run_program.h"

namespace welkin::app {
namespace {
using measure::ConvergeSetting, measure::Frames;
using testing::ElementsAre, testing::HasSubstr;

TEST(Sweep, axesAreReadWithCare) {
  const auto axis = parseSweep("step=0.1,0.2");
  ASSERT_TRUE(axis.ok());
  EXPECT_EQ(axis->name, "step");
  EXPECT_THAT(axis->values, ElementsAre("0.1", "0.2"));
  for (const char* right : {"integrator=simpson-3/8", "step-rule=node", "budget=64MiB", "depth=24", "detail=0", "frames=still",
                            "brick-bits=8", "light=0.5", "skip-empty=0", "spread=12.5"})
    EXPECT_TRUE(parseSweep(right).ok()) << right;
  for (const char* wrong : {"", "step", "step=", "step=1,", "step=nan", "step=1e-9", "colour=red", "integrator=euler", "depth=25",
                            "depth=1.5", "brick-bits=4", "budget=1", "light=0", "skip-empty=2", "frames=all", "spread=256"})
    EXPECT_FALSE(parseSweep(wrong).ok()) << wrong;
}

TEST(Sweep, everyCombinationWithItsName) {
  ConvergeSetting base;
  base.quality.step = 0.32;
  const auto all = combine(base, {*parseSweep("step=0.1,0.2"), *parseSweep("budget=64MiB,512MiB")});
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[0].name, "exponential-linear optical 0.1, 64 MiB");
  EXPECT_EQ(all[3].name, "exponential-linear optical 0.2");  // 512 MiB is the base's
  EXPECT_EQ(all[3].quality.budget_bytes, 512ull << 20);
  // Lines join what differs in the step.
  EXPECT_THAT(all[0].series, ElementsAre("exponential-linear optical, 64 MiB"));
  EXPECT_EQ(all[0].series, all[2].series);
  EXPECT_NE(all[0].series, all[1].series);
  const auto budgets = combine(base, {*parseSweep("budget=64MiB,512MiB")});
  EXPECT_EQ(budgets[0].series, budgets[1].series);
}

TEST(Sweep, aSettingTwiceIsMeasuredOnce) {
  ConvergeSetting base;
  std::vector<ConvergeSetting> all;
  merge(all, combine(base, {*parseSweep("step=0.32,0.16")}));
  merge(all, combine(base, {*parseSweep("budget=512MiB,256MiB")}));
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].series.size(), 2u);
}

TEST(Sweep, presetsHaveSettingsWithDifferentNames) {
  for (const char* preset : kPresetNames) {
    if (std::string(preset) == "thesis") continue;  // looks for its budget first
    const auto all = presetSettings(preset, {});
    EXPECT_GE(all.size(), 3u) << preset;
    for (std::size_t i = 0; i < all.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) EXPECT_NE(all[i].name, all[k].name) << preset;
  }
}

TEST(Thesis, budgetsAndStepsOfTheTable) {
  const auto all = thesisSettings({}, {100ull << 20, 400ull << 20});
  ASSERT_EQ(all.size(), 18u);  // its way and ours
  EXPECT_EQ(all[0].quality.integrator, Integrator::Rectangle);
  EXPECT_EQ(all[0].quality.stepRule, StepRule::Node);
  EXPECT_FALSE(all[0].quality.skipEmpty);
  EXPECT_EQ(all[0].quality.depth, kThesisDepth);
  std::vector<measure::ConvergeRow> rows(18);
  for (std::size_t i = 0; i < 18; ++i) rows[i].setting = all[i], rows[i].time_ms.median = double(i), rows[i].best_rmse_255 = 0.5;
  const auto tables = thesisTables(rows);
  ASSERT_EQ(tables.size(), 3u);
  EXPECT_EQ(tables[0].cells[2][0].time_ms, 12.8);  // published: 2 GiB, step 0.1
  EXPECT_THAT(tables[1].budgets, ElementsAre("500 MiB, all of the tree", "300 MiB, half of it", "200 MiB, a quarter"));
  EXPECT_THAT(tables[1].steps, ElementsAre("step 0.1", "step 0.2", "step 0.4"));
  EXPECT_EQ(tables[1].cells[2][1].time_ms, 7);  // smallest budget, middle step
  EXPECT_EQ(tables[2].cells[0][0].time_ms, 9);
}

TEST(ConvergeCommand, wrongUsage) {
  EXPECT_EQ(test::run({"converge"}).exit, 2);
  const auto axis = test::run({"converge", "x.json", "--sweep", "colour=red"});
  EXPECT_EQ(axis.exit, 2);
  EXPECT_THAT(axis.err, HasSubstr("expected one of: step, integrator"));
  EXPECT_EQ(std::count(axis.err.begin(), axis.err.end(), '\n'), 1);
  EXPECT_EQ(test::run({"converge", "x.json", "--preset", "all"}).exit, 2);
  EXPECT_EQ(test::run({"converge", "/nowhere/x.json"}).exit, 1);
  EXPECT_THAT(test::run({"converge", "--help"}).out, HasSubstr("welkin converge benchmarks/poses/near.json"));
}

}  // namespace
}  // namespace welkin::app
