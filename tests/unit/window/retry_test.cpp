#include "welkin/window/retry.h"

#include <gtest/gtest.h>

namespace welkin::window {
namespace {

TEST(Retry, TriesAgainEverySecondAndSaysItOnce) {
  Retry<int> retry;
  int tries = 0, said = 0;
  for (double now_ms = 0; now_ms < 3500; now_ms += 20) {
    if (!retry.due(7, now_ms)) continue;
    ++tries;
    said += retry.tried(7, false, now_ms);
  }
  EXPECT_EQ(tries, 4);  // at 0, 1, 2 and 3 s
  EXPECT_EQ(said, 1);
}

TEST(Retry, AnotherGoalIsTriedAtOnce) {
  Retry<int> retry;
  EXPECT_TRUE(retry.tried(7, false, 0));
  EXPECT_TRUE(retry.due(8, 1));
  EXPECT_TRUE(retry.tried(8, false, 1));
  EXPECT_FALSE(retry.due(8, 2));
}

TEST(Retry, WhatWentWellMayFailAnew) {
  Retry<int> retry;
  EXPECT_TRUE(retry.tried(7, false, 0));
  EXPECT_FALSE(retry.tried(7, true, 1000));
  EXPECT_TRUE(retry.due(7, 1001));
  EXPECT_TRUE(retry.tried(7, false, 1001));
}

}  // namespace
}  // namespace welkin::window
