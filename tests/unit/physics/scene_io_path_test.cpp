#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene_io_support.h"
#include "welkin/physics/path_io.h"

namespace welkin {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using testing_support::expectOneLine;

const std::string kPath = R"({"scene": "s.json", "size": [320, 180], "time_step_s": 0.04, "warm_up": 30, "frames": [
 {"position_m": [7000000, 0, 0], "orientation_xyzw": [0, 0, 0, 1], "fov_deg": 58, "time_s": 0},
 {"position_m": [7000000, 100, 0], "orientation_xyzw": [0.5, 0.5, 0.5, 0.5], "fov_deg": 40, "exposure_ev": 2}]}
)";

std::string errorOf(const std::string& text) {
  auto path = parsePath(text, "test.json");
  EXPECT_FALSE(path.ok()) << text;
  if (path.ok()) return "";
  expectOneLine(path.error().message);
  return path.error().message;
}
std::string replaced(const std::string& what, const std::string& by) {
  std::string text = kPath;
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(PathIo, readsAndWrites) {
  auto path = parsePath(kPath, "test.json", "/folder");
  ASSERT_TRUE(path.ok()) << path.error().message;
  EXPECT_EQ(path->scene, "/folder/s.json");
  EXPECT_EQ(path->width, 320);
  EXPECT_EQ(path->height, 180);
  EXPECT_EQ(path->warmUp, 30);
  ASSERT_EQ(path->frames.size(), 2u);
  EXPECT_EQ(path->frames[1].time_s, 0.04);  // not given: the frame's number times the step
  EXPECT_EQ(path->frames[1].view.exposure_ev, 2);
  const std::string text = pathToJson(*path, "/folder");
  auto again = parsePath(text, "test.json", "/folder");
  ASSERT_TRUE(again.ok()) << again.error().message;
  EXPECT_EQ(pathToJson(*again, "/folder"), text);
  EXPECT_EQ(again->frames[1].view.position_m, path->frames[1].view.position_m);
}

TEST(PathIo, wrongValuesAreToldWithTheirPlace) {
  EXPECT_THAT(errorOf(replaced("[320, 180]", "[0, 180]")),
              StartsWith("test.json: /size/0: expected a whole number from 1 to 16384, got 0"));
  EXPECT_THAT(errorOf(replaced("[320, 180]", "[320, 100000]")), HasSubstr("/size/1"));
  EXPECT_THAT(errorOf(replaced("[320, 180]", "[320]")), HasSubstr("/size: expected a list of 2"));
  EXPECT_THAT(errorOf(replaced("0.04", "-1")), HasSubstr("/time_step_s"));
  EXPECT_THAT(errorOf(replaced("[7000000, 100, 0]", "[7000000, 100]")), HasSubstr("/frames/1/position_m: expected a list of 3"));
  EXPECT_THAT(errorOf(replaced("[7000000, 100, 0]", "[7000000, 1e400, 0]")), HasSubstr("/frames/1/position_m/1"));
  EXPECT_THAT(errorOf(replaced("\"fov_deg\": 40", "\"fov\": 40")), HasSubstr("/frames/1/fov: unknown key"));
  EXPECT_THAT(errorOf(R"({"scene": "s.json", "frames": []})"), HasSubstr("/frames: expected a list of 1 to"));
  EXPECT_THAT(errorOf(R"({"frames": [{}]})"), HasSubstr("\"scene\""));
}

TEST(PathIo, positionsBelowTheGroundAreFound) {
  auto path = parsePath(replaced("[7000000, 100, 0]", "[5000000, 100, 0]"), "test.json");
  ASSERT_TRUE(path.ok());
  path->file = "test.json";
  const auto checked = checkPath(*path, Planet{});
  ASSERT_FALSE(checked.ok());
  EXPECT_THAT(checked.error().message, StartsWith("test.json: /frames/1/position_m: expected a position above the ground"));
}

TEST(PathIo, truncatedAndFlippedBytesAreOneLine) {
  for (std::size_t n = 0; n <= kPath.rfind('}'); ++n) errorOf(kPath.substr(0, n));
  for (std::size_t i = 0; i < kPath.size(); ++i) {
    for (const int mask : {0x01, 0x20, 0x80, 0xff}) {
      std::string text = kPath;
      text[i] = static_cast<char>(text[i] ^ mask);
      auto path = parsePath(text, "test.json");
      if (!path.ok()) expectOneLine(path.error().message);
    }
  }
}

}  // namespace
}  // namespace welkin
