// `welkin stress` as a command: wrong usage, orders without GL, and the map of a report.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "run_program.h"
#include "welkin/app/stress_map.h"
#include "welkin/core/files.h"

namespace welkin::app {
namespace {
namespace fs = std::filesystem;
using test::run;

TEST(StressCommand, wrongUsageIsOneLine) {
  for (const auto& arguments : {std::vector<const char*>{"stress", "--rays", "0"},
                                {"stress", "--rays", "many"},
                                {"stress", "--png", "map.jpg"},
                                {"stress", "extra"}}) {
    const auto ran = run(arguments);
    EXPECT_EQ(ran.exit, 2);
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_EQ(ran.out, "");
  }
}

TEST(StressCommand, ordersArePrintedAndWritten) {
  const fs::path file = fs::path(testing::TempDir()) / ("stress-orders-" + std::to_string(::getpid()) + ".json");
  const auto ran = run({"stress", "--orders", "--quiet", "--json", file.c_str()});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_THAT(ran.out, testing::HasSubstr("simpson-3/8"));
  const auto text = readFile(file);
  ASSERT_TRUE(text.ok());
  const auto json = nlohmann::json::parse(*text);
  EXPECT_EQ(json["cells"].size(), 0u);
  EXPECT_GT(json["orders"].size(), 20u);
  for (const auto& order : json["orders"]) EXPECT_TRUE(order["ok"]) << order;
  fs::remove(file);
}

// Cells are coloured, and what fails is crossed in white.
TEST(StressCommand, mapShowsWhatFails) {
  measure::StressReport report;
  report.defaultIntegrator = "exponential-linear";
  const auto white = [&] {
    const Image8 map = stressMap(report);
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < map.rgba.size(); i += 4) pixels += map.rgba[i] == 255 && map.rgba[i + 1] == 255 && map.rgba[i + 2] == 255;
    return pixels;
  };
  for (const double x : {1e-3, 1.0, 1e3}) {
    measure::StressCell cell;
    cell.group = "lines", cell.axis = "optical depth per step", cell.value = x, cell.integrator = "rectangle";
    cell.relativeError = 0.01, cell.limit = 0.05;
    report.cells.push_back(cell);
  }
  EXPECT_EQ(white(), 0u);
  report.cells.back().relativeError = 500;
  EXPECT_GT(white(), 20u);
}

}  // namespace
}  // namespace welkin::app
