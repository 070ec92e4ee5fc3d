// Frame N of a flight is the same picture, to the byte, for any timing of the worker and any number of the driver's threads.
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "flights.h"
#include "welkin/core/files.h"

namespace welkin {
namespace {
using namespace test;
namespace fs = std::filesystem;
using Determinism = GlTest;

constexpr int kFrames = 24, kWidth = 32, kHeight = 18;     // so small that a frame is over before a delayed worker is
constexpr const char* kOutput = "WELKIN_TEST_FLIGHT_OUT";  // a child process draws its flight into this file

// A cold start in fast motion: every frame streams, generates, lights and reprojects. All pictures, one after another.
std::string flight(gpu::Context& context, std::uint32_t jitterSeed) {
  const auto renderer =
      makeRenderer(context, quickEarth(), {.width = kWidth, .height = kHeight, .bricksPerFrame = 32, .workerJitterSeed = jitterSeed});
  if (!renderer) return {};
  std::string pictures;
  std::uint64_t generated = 0, lit = 0;
  for (int i = 0; i < kFrames; ++i) {
    const FrameStats stats = renderer->frame(sideways(i, 100));
    const Image8 image = renderer->image();
    pictures.append(image.rgba.begin(), image.rgba.end());
    generated += stats.bricksGenerated, lit += stats.bricksLit;
  }
  EXPECT_GT(generated, 500u) << "the flight must stream";
  EXPECT_GT(lit, 50u);
  EXPECT_GT(contrast(renderer->image()), 0.05);
  return pictures;
}

void expectSame(const std::string& a, const std::string& b, const char* what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  ASSERT_FALSE(a.empty());
  const std::size_t frame = a.size() / kFrames;
  for (std::size_t i = 0; i < a.size(); ++i)
    ASSERT_EQ(a[i], b[i]) << what << ": frame " << i / frame << ", pixel " << i % frame / 4 % kWidth << "," << i % frame / 4 / kWidth;
}

// The driver reads LP_NUM_THREADS when its first context is made: another process.
std::string flightInAnotherProcess(const char* threads) {
  const fs::path file = fs::temp_directory_path() / ("welkin_flight_" + std::to_string(::getpid()) + "_" + threads);
  const pid_t child = ::fork();
  if (child == 0) {
    ::setenv("LP_NUM_THREADS", threads, 1);
    ::setenv(kOutput, file.c_str(), 1);
    ::execl("/proc/self/exe", "gpu_render", "--gtest_also_run_disabled_tests", "--gtest_filter=Determinism.DISABLED_Child",
            static_cast<char*>(nullptr));
    ::_exit(127);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << "the child with " << threads << " driver threads";
  auto pictures = readFile(file);
  fs::remove(file);
  EXPECT_TRUE(pictures.ok());
  return pictures.ok() ? std::move(*pictures) : std::string();
}

TEST_F(Determinism, DISABLED_Child) {
  const char* file = std::getenv(kOutput);
  ASSERT_NE(file, nullptr) << "drawn by the test below, in another process";
  ASSERT_TRUE(writeFile(file, flight(*context, 0)).ok());
}

TEST_F(Determinism, DelaysInTheWorkerChangeNoPicture) {
  const std::string plain = flight(*context, 0);
  for (const std::uint32_t seed : {7u, 8u}) expectSame(plain, flight(*context, seed), "random delays of up to 4 ms before each step");
  // and two frames are not the same picture: a comparison of blank pictures would pass
  EXPECT_NE(plain.substr(0, plain.size() / kFrames), plain.substr(plain.size() - plain.size() / kFrames));
}

TEST_F(Determinism, ThreadsOfTheDriverChangeNoPicture) {
  if (!context->device().software) GTEST_SKIP() << "a GPU has no LP_NUM_THREADS";
  expectSame(flightInAnotherProcess("1"), flightInAnotherProcess("2"), "one driver thread and two");
}

}  // namespace
}  // namespace welkin
