// The worker thread's manners.
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "fake_source.h"
#include "welkin/stream/streamer.h"

namespace welkin {
namespace {

using Clock = std::chrono::steady_clock;
const RootFrame kRoot = RootFrame::enclosing(6'371'000, 9000);
const test::FakeSource kSource(kRoot, 1000, 9000);

FrameInput input(std::uint64_t frame) {
  FrameInput in;
  in.frame = frame;
  in.camera.position_m = {6'375'000, 0, 0};
  return in;
}

TEST(Streamer, TakesWhatWasPostedInOrder) {
  Streamer s(kSource, kRoot, {12, 300, 300, 0});
  for (std::uint64_t f = 0; f < 20; ++f) s.post(input(f));
  for (std::uint64_t f = 0; f < 20; ++f) EXPECT_EQ(s.take(f).frame, f);
}

TEST(Streamer, ReadyTurnsTrueAndTakeEmptiesIt) {
  Streamer s(kSource, kRoot, {12, 300, 300, 0});
  EXPECT_FALSE(s.ready(0));
  s.post(input(0));
  while (!s.ready(0)) std::this_thread::yield();
  s.take(0);
  EXPECT_FALSE(s.ready(0));
}

TEST(Streamer, AFrameThatWasNeverPostedIsAnErrorNotAWait) {
  Streamer s(kSource, kRoot, {12, 300, 300, 0});
  EXPECT_THROW(s.take(5), std::logic_error);
}

TEST(Streamer, AnErrorInTheWorkerComesOutOfTake) {
  struct Throws : test::FakeSource {
    using FakeSource::FakeSource;
    Bounds bounds(glm::uvec3, std::uint32_t) const override { throw std::runtime_error("no bounds"); }
  } source(kRoot, 1000, 9000);
  Streamer s(source, kRoot, {12, 300, 300, 0});
  s.post(input(0));
  s.post(input(1));
  EXPECT_THROW(s.take(0), std::runtime_error);
  EXPECT_THROW(s.take(1), std::runtime_error);
}

TEST(Streamer, StopsAtOnceWithWorkInTheQueue) {
  const auto start = Clock::now();
  {
    Streamer s(kSource, kRoot, {14, 5000, 5000, 0}, 3);
    for (std::uint64_t f = 0; f < 2000; ++f) s.post(input(f));
  }
  // 2,000 frames with up to 4 ms of sleep each would take seconds; one step takes milliseconds.
  EXPECT_LT(Clock::now() - start, std::chrono::milliseconds(1000));
}

TEST(StreamState, RefusesSettingsThatCannotWork) {
  EXPECT_THROW(StreamState(kSource, kRoot, {0, 300, 300, 0}), std::invalid_argument);
  EXPECT_THROW(StreamState(kSource, kRoot, {25, 300, 300, 0}), std::invalid_argument);
  EXPECT_THROW(StreamState(kSource, kRoot, {12, 1, 300, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace welkin
