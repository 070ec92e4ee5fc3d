// The stability matrix's pictures in small: the renderer itself, in every corner of every axis.
#include <cstdio>

#include "gl_fixture.h"
#include "welkin/measure/stress.h"

namespace welkin::measure {
namespace {
using StressPictures = test::GlTest;

TEST_F(StressPictures, DefaultFailsNowhereAndOthersWhereItIsSaid) {
  const auto cells = stressPictures(*context, {.quick = true});
  ASSERT_TRUE(cells.ok()) << cells.error().message;
  StressReport report;
  report.defaultIntegrator = kIntegratorNames[std::size_t(Quality{}.integrator)];
  report.cells = *cells;
  EXPECT_GT(report.rays(), 100'000u);
  std::size_t truths = 0;
  for (const StressCell& c : report.cells) {
    EXPECT_EQ(c.nan + c.inf + c.negative, 0u) << c.axis << " " << c.value << ", " << c.variant << ", " << c.integrator;
    EXPECT_EQ(c.note, "") << c.axis << " " << c.value << ", " << c.variant;
    EXPECT_TRUE(c.ok() || c.predictedFail) << c.axis << " " << c.value << ", " << c.variant << ", " << c.integrator << ": error "
                                           << c.relativeError.value_or(0) << ", " << c.overFurnace << " over";
    truths += c.relativeError.has_value();
  }
  EXPECT_EQ(report.failingOfDefault(), 0u);
  EXPECT_GT(truths, report.cells.size() / 2) << "most cells are held to a truth";
  // The explicit rules must be seen to fail in the renderer itself, or the matrix could not see anything fail.
  const auto fails = [](const StressCell& c) { return c.integrator == "rectangle" && c.value == 1e6 && !c.ok(); };
  EXPECT_TRUE(std::any_of(report.cells.begin(), report.cells.end(), fails));
}

}  // namespace
}  // namespace welkin::measure
