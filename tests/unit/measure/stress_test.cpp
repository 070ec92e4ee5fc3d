// The matrix's lines in small: what must hold, and that the report says what it found.
#include "welkin/measure/stress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace welkin::measure {
namespace {

StressReport quickReport() {
  StressReport report;
  report.defaultIntegrator = kIntegratorNames[std::size_t(Quality{}.integrator)];
  report.cells = stressLines({.quick = true, .rays = 40'000});
  report.orders = checkOrders();
  return report;
}

TEST(Stress, linesFailOnlyWhereTheReportSaysAndTheDefaultNowhere) {
  const StressReport report = quickReport();
  EXPECT_GE(report.rays(), 40'000u);
  EXPECT_EQ(report.mispredicted(), 0u);
  EXPECT_EQ(report.failingOfDefault(), 0u);
  EXPECT_TRUE(report.ok());
  for (const StressCell& c : report.cells) {
    const bool exponential = c.integrator.starts_with("exponential") || c.integrator == "adaptive";
    EXPECT_EQ(c.nan + c.inf + c.negative, 0u) << c.axis << " " << c.value << " " << c.integrator;
    EXPECT_TRUE(!exponential || (c.ok() && !c.predictedFail))
        << c.axis << " " << c.value << ", " << c.variant << ", " << c.integrator << ": " << c.relativeError.value_or(0);
    // where a step is a hundred optical depths thick no explicit rule is right, and it is said so
    if (!exponential && c.axis == "optical depth per step" && c.value > 90) {
      EXPECT_FALSE(c.ok()) << c.value << " " << c.integrator;
      EXPECT_TRUE(c.predictedFail);
    }
    // and where it is thin all of them are
    if (c.axis == "optical depth per step" && c.value < 2e-3) {
      EXPECT_TRUE(c.ok()) << c.value << " " << c.variant << " " << c.integrator;
    }
  }
  // A prediction that says "fails" everywhere would be no prediction.
  EXPECT_LT(report.pessimistic(), report.cells.size() / 6);
}

TEST(Stress, jsonHasWhatWasPromised) {
  const StressReport report = quickReport();
  const auto json = nlohmann::json::parse(report.json());
  EXPECT_EQ(json["default_integrator"], "exponential-linear");
  EXPECT_EQ(json["rays"], report.rays());
  EXPECT_EQ(json["mispredicted"], 0);
  ASSERT_EQ(json["cells"].size(), report.cells.size());
  for (const char* key :
       {"group", "axis", "value", "case", "integrator", "nan", "inf", "negative", "over_furnace", "relative_error", "predicted_fail", "ok"})
    EXPECT_TRUE(json["cells"][0].contains(key)) << key;
  for (const char* name : kIntegratorNames)
    for (const char* key : {"cells", "failing", "nan", "inf", "negative"})
      EXPECT_TRUE(json["integrators"][name].contains(key)) << name << " " << key;
  EXPECT_EQ(json["orders"].size(), report.orders.size());
  EXPECT_GT(json["integrators"]["rectangle"]["failing"], 0);
  EXPECT_EQ(json["integrators"]["exponential-linear"]["failing"], 0);
}

}  // namespace
}  // namespace welkin::measure
