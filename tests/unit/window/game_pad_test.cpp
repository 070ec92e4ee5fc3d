#include "welkin/window/game_pad.h"

#include <gtest/gtest.h>

#include <limits>

namespace welkin::window {
namespace {

app::FlyInput with(const GamePad& pad) {
  app::FlyInput input;
  addPad(pad, 0.1, input);
  return input;
}

TEST(GamePad, AtRestNothingMoves) {
  GamePad pad;
  pad.left = {0.1, -0.1}, pad.right = {-0.12, 0.05};  // as worn sticks are
  const app::FlyInput in = with(pad);
  EXPECT_EQ(in.move, glm::dvec3(0));
  EXPECT_EQ(in.turn_rad, glm::dvec2(0));
  EXPECT_EQ(in.roll, 0);
  EXPECT_FALSE(in.fast);
}

TEST(GamePad, SticksBeginWithoutAJump) {
  GamePad pad;
  pad.left = {0, -(kPadDead + 1e-6)};
  EXPECT_NEAR(with(pad).move.z, 0, 2e-6);  // 1e-6 over what is left of the way
  EXPECT_LT(with(pad).move.z, 0);          // forward
}

TEST(GamePad, FullSticksAreFullSpeedInAnyDirection) {
  GamePad pad;
  pad.left = {0.8, 0.6};
  EXPECT_NEAR(with(pad).move.x, 0.8, 1e-15);  // rounding of a length and two products
  EXPECT_NEAR(with(pad).move.z, 0.6, 1e-15);
  pad.left = {1, 1};  // square sticks reach corners
  EXPECT_NEAR(glm::length(with(pad).move), 1, 1e-15);
}

TEST(GamePad, LooksWhereTheStickPoints) {
  GamePad pad;
  pad.right = {1, 0};
  EXPECT_NEAR(with(pad).turn_rad.x, 0.1 * kPadTurnRate_rad_s, 1e-15);
  pad.right = {0, -1};  // away from oneself: up
  EXPECT_NEAR(with(pad).turn_rad.y, 0.1 * kPadTurnRate_rad_s, 1e-15);
}

TEST(GamePad, TriggersAndShoulders) {
  GamePad pad;
  pad.rightTrigger = 1;
  EXPECT_EQ(with(pad).move.y, 1);
  pad.leftTrigger = 1;
  EXPECT_EQ(with(pad).move.y, 0);
  pad.rightShoulder = true;
  EXPECT_EQ(with(pad).roll, 1);
  pad.fast = true;
  EXPECT_TRUE(with(pad).fast);
}

TEST(GamePad, AddsToTheKeys) {
  app::FlyInput input;
  input.move = {1, 0, 0};
  GamePad pad;
  pad.left = {-1, 0};
  addPad(pad, 0.1, input);
  EXPECT_EQ(input.move, glm::dvec3(0));
}

TEST(GamePad, WhatIsNotANumberIsNothing) {
  GamePad pad;
  pad.left = {std::numeric_limits<double>::quiet_NaN(), 1};
  EXPECT_EQ(with(pad).move, glm::dvec3(0));
}

}  // namespace
}  // namespace welkin::window
