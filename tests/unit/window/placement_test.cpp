#include "welkin/window/placement.h"

#include <gtest/gtest.h>

#include "random32.h"

namespace welkin::window {
namespace {

const Area kLeft{0, 25, 1920, 1055}, kRight{1920, 0, 2560, 1440};  // the first one with a bar at its top

TEST(Placement, StaysWhereItCanBeTakenHoldOf) {
  const Area both[] = {kLeft, kRight};
  for (const auto& at : {std::pair(100, 60), {1800, 300}, {-1100, 200}, {4300, 1300}, {0, 25}}) {
    const Placement p = onto(both, {{1280, 800}, at, true});
    EXPECT_EQ(*p.position, at);
    EXPECT_EQ(p.size.width, 1280);
    EXPECT_TRUE(p.maximized);
  }
}

TEST(Placement, ComesBackFromBesideTheMonitors) {
  const Area one[] = {kLeft};
  const auto moved = [&](std::pair<int, int> at) { return *onto(one, {{1280, 800}, at, false}).position; };
  EXPECT_EQ(moved({2500, 300}), std::pair(640, 280));  // the monitor on the right is gone
  EXPECT_EQ(moved({-5000, -5000}), std::pair(0, 65));  // with room for its title
  EXPECT_EQ(moved({300, 5000}), std::pair(300, 280));
  EXPECT_EQ(moved({300, -30}), std::pair(300, 65));
  EXPECT_EQ(moved({-1270, 100}), std::pair(0, 100));  // 10 pixels are not enough to take hold of
}

TEST(Placement, NeverLargerThanTheMonitor) {
  const Area one[] = {kLeft};
  const Placement p = onto(one, {{65536, 65536}, std::pair(5000, 5000), false});
  EXPECT_EQ(p.size.width, 1920);
  EXPECT_EQ(p.size.height, 1055);
  EXPECT_EQ(*p.position, std::pair(0, 25));
  EXPECT_EQ(onto(one, {{3000, 500}, {}, false}).size.width, 1920);
  EXPECT_FALSE(onto(one, {{300, 500}, {}, false}).position);
  EXPECT_EQ(*onto({}, {{300, 500}, std::pair(9999, 9999), false}).position, std::pair(9999, 9999));
}

// Whatever a file says: what comes out lies where a hand reaches it, and coming out once more changes nothing.
TEST(Placement, AnyPositionEndsWithinReach) {
  test::Random32 random(3);
  const Area both[] = {kLeft, kRight};
  const auto below = [&](int n) { return int(random() % unsigned(n)); };
  for (int i = 0; i < 20000; ++i) {
    const Placement wanted{
        {1 + below(5000), 1 + below(5000)}, std::pair(below(2'000'000) - 1'000'000, below(2'000'000) - 1'000'000), false};
    const Placement p = onto(both, wanted);
    const auto [x, y] = *p.position;
    EXPECT_TRUE(x < 1920 + 2560 && x + p.size.width > 0 && y >= 0 && y < 1440) << x << " " << y;
    EXPECT_EQ(*onto(both, p).position, *p.position);
  }
}

}  // namespace
}  // namespace welkin::window
