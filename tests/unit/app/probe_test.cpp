// Tables of rays: what is read, what is written back, what is refused and how.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "run_program.h"
#include "welkin/app/cli.h"
#include "welkin/app/probe_csv.h"
#include "welkin/core/files.h"

namespace welkin::app {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr const char* kHeader = "altitude_m,sun_zenith_deg,view_zenith_deg,relative_azimuth_deg\n";

std::string refusal(const std::string& text) {
  auto table = parseProbeTable(text, "r.csv");
  return table.ok() ? "accepted" : table.error().message;
}

TEST(ProbeTable, ColumnsByNameInAnyOrder) {
  const auto table = parseProbeTable(
      "\xEF\xBB\xBFview_zenith_deg, max_distance_m,altitude_m,longitude_deg,latitude_deg,relative_azimuth_deg,sun_zenith_deg\r\n"
      "90,,2,10,-45,180,30\r\n\r\n 45 ,1e3,-7.50,0,90,-20,0\n",
      "r.csv");
  ASSERT_TRUE(table.ok()) << table.error().message;
  ASSERT_EQ(table->rays.size(), 2u);
  constexpr double kPi = std::numbers::pi;
  EXPECT_DOUBLE_EQ(table->rays[0].viewZenith_rad, kPi / 2);
  EXPECT_TRUE(std::isinf(table->rays[0].maxDistance_m));
  EXPECT_DOUBLE_EQ(table->rays[0].latitude_rad, -kPi / 4);
  EXPECT_DOUBLE_EQ(table->rays[0].sunZenith_rad, kPi / 6);
  EXPECT_EQ(table->rays[1].altitude_m, -7.5);
  EXPECT_EQ(table->rays[1].maxDistance_m, 1000);
  EXPECT_EQ(table->rows[1], " 45 ,1e3,-7.50,0,90,-20,0");  // kept as it is
}

TEST(ProbeTable, WritesRowsBackWithNineDigits) {
  const auto table = parseProbeTable(std::string(kHeader) + "0.0,1e1,20,+3\n", "r.csv");
  ASSERT_TRUE(table.ok());
  ProbeResult result;
  result.radiance = {1.0 / 3, 1e-20 / 3, 0}, result.transmittance = {1, 0.5, 2.0 / 3}, result.standardError = {0.1, 0, 1e-9};
  EXPECT_EQ(probeResultText(*table, {result}, false),
            "altitude_m,sun_zenith_deg,view_zenith_deg,relative_azimuth_deg,radiance_680,radiance_550,radiance_440,transmittance_680,"
            "transmittance_550,transmittance_440\n0.0,1e1,20,+3,0.333333333,3.33333333e-21,0,1,0.5,0.666666667\n");
  EXPECT_THAT(probeResultText(*table, {result}, true), HasSubstr(",standard_error_680,standard_error_550,standard_error_440\n"));
  EXPECT_THAT(probeResultText(*table, {result}, true), HasSubstr(",0.666666667,0.1,0,1e-09\n"));
}

TEST(ProbeTable, SaysFileLineColumnAndWhatWasExpected) {
  EXPECT_EQ(refusal(""), "r.csv: line 1: expected the names of the columns, found nothing");
  EXPECT_EQ(refusal("altitude_m,sun_zenith_deg,view_zenith_deg\n"), "r.csv: line 1: expected a column relative_azimuth_deg");
  EXPECT_EQ(refusal("altitude_m,what\n"), "r.csv: line 1: column 2: expected the name of a column of rays, got 'what'");
  EXPECT_EQ(refusal("altitude_m,altitude_m\n"), "r.csv: line 1: column 2: expected each column once, got altitude_m again");
  EXPECT_EQ(refusal("latitude_deg," + std::string(kHeader)), "r.csv: line 1: expected latitude_deg and longitude_deg together");
  const std::string h = kHeader;
  EXPECT_EQ(refusal(h + "1,2,3\n"), "r.csv: line 2: expected 4 columns, got 3");
  EXPECT_EQ(refusal(h + "1,2,3,4\n\n1,2,3,4,5\n"), "r.csv: line 4: expected 4 columns, got 5");
  EXPECT_EQ(refusal(h + "1,200,3,4\n"), "r.csv: line 2: sun_zenith_deg: expected degrees from 0 to 180, got '200'");
  EXPECT_EQ(refusal(h + "1,2,x,4\n"), "r.csv: line 2: view_zenith_deg: expected degrees from 0 to 180, got 'x'");
  for (const char* wrong : {"", "nan", "inf", "1 2", "1e13", "0x"})
    EXPECT_THAT(refusal(h + wrong + ",2,3,4\n"), HasSubstr("line 2: altitude_m: expected metres")) << wrong;
  EXPECT_EQ(refusal("max_distance_m," + h + "-1,0,1,2,3\n"), "r.csv: line 2: max_distance_m: expected metres at least 0, got '-1'");
}
using test::Ran, test::run;

TEST(ProbeCommand, RunsAndFailsInOneLine) {
  const fs::path folder = fs::temp_directory_path() / ("welkin-probe-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  const std::string rays = (folder / "rays.csv").string(), out = (folder / "out.csv").string();
  const std::string scene = std::string(WELKIN_SOURCE_DIR) + "/benchmarks/left-out/no-clouds.json";
  ASSERT_TRUE(writeFile(rays, std::string(kHeader) + "0,30,60,90\n1000,96,95,0\n").ok());
  const Ran once = run({"probe", scene.c_str(), "--rays", rays.c_str(), "--orders", "1", "--quiet"});
  EXPECT_EQ(once.exit, 0) << once.err;
  EXPECT_EQ(std::count(once.out.begin(), once.out.end(), '\n'), 3);
  EXPECT_THAT(once.out, HasSubstr("transmittance_440\n0,30,60,90,0.0"));
  const Ran all = run({"probe", scene.c_str(), "--rays", rays.c_str(), "--max-paths", "100", "--quiet", "-o", out.c_str()});
  EXPECT_EQ(all.exit, 0) << all.err;
  EXPECT_EQ(all.out, "");
  EXPECT_THAT(*readFile(out), HasSubstr("standard_error_440\n0,30,60,90,0.0"));

  const auto fails = [&](std::vector<const char*> more, int code, const char* says) {
    more.insert(more.begin(), "probe");
    const Ran r = run(more);
    EXPECT_EQ(r.exit, code);
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << r.err;
    EXPECT_THAT(r.err, HasSubstr(says));
  };
  fails({scene.c_str(), "--rays", (folder / "none.csv").c_str(), "--quiet"}, 1, "none.csv: cannot be read");
  fails({scene.c_str(), "--rays", rays.c_str(), "--orders", "0"}, 2, "--orders");
  fails({scene.c_str(), "--rays", rays.c_str(), "--method", "guess"}, 2, "--method");
  fails({scene.c_str()}, 2, "--rays");
  ASSERT_TRUE(writeFile(rays, std::string(kHeader) + "0,30,60\n").ok());
  fails({scene.c_str(), "--rays", rays.c_str(), "--quiet", "-o", out.c_str()}, 1, "line 2: expected 4 columns, got 3");
  EXPECT_THAT(*readFile(out), HasSubstr("standard_error_440"));  // what lay there is whole
  fs::remove_all(folder);
}

}  // namespace
}  // namespace welkin::app
