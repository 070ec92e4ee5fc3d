// The byte budget, and that what a scene leaves out costs nothing.
#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <set>

#include "flights.h"
#include "welkin/render/sky/sky_tables.h"

namespace welkin {
namespace {
using namespace test;
using Budget = GlTest;

constexpr std::uint64_t kMiB = 1 << 20;

TEST_F(Budget, IsKeptInEveryFrameAndUsed) {
  for (const std::uint64_t budget : {64 * kMiB, 128 * kMiB, 300 * kMiB}) {
    Scene scene = smallEarth();
    scene.quality.budget_bytes = budget;
    const auto renderer = makeRenderer(*context, scene, {.width = 96, .height = 54, .bricksPerFrame = 1024});
    ASSERT_NE(renderer, nullptr);
    FrameStats stats;
    for (int i = 0; i < 8; ++i) {
      stats = renderer->frame(sideways(i, 500));
      EXPECT_LE(stats.bytesUsed, budget) << "frame " << i;
      EXPECT_EQ(stats.bytesUsed, renderer->memory().used());
      EXPECT_EQ(stats.bytesBudget, budget);
      EXPECT_LE(stats.residency.bricks, stats.residency.brickCapacity);
      EXPECT_LE(stats.residency.cpuBytes, budget / 4) << "the CPU's mirror, at most a quarter";
    }
    // What is left is less than one more layer of 1024 bricks: 1024 * 2048 bytes and 768 groups of 64 bytes.
    EXPECT_GT(stats.bytesUsed + 1024 * 2048 + 768 * 64 + 8192, budget);
    EXPECT_GT(stats.residency.bricks, 1000u);
    // Every byte has a name: frame targets are the rest.
    std::uint64_t named = 0;
    for (const auto& [name, bytes] : renderer->memory().byName()) named += bytes;
    EXPECT_EQ(named, renderer->memory().used() + renderer->memory().frameTargets());
  }
}

double residentMiB() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0, resident = 0;
  statm >> pages >> resident;
  return resident * double(sysconf(_SC_PAGESIZE)) / double(kMiB);
}

// The pass of the debug view is the last one: a driver keeps what that was given.
TEST_F(Budget, IsGivenBackWithTheRenderer) {
  if (!context->device().software) GTEST_SKIP() << "the memory of a GPU is not the process'";
  Scene scene = smallEarth();
  scene.quality.budget_bytes = 512 * kMiB;
  const double before = residentMiB();
  auto renderer = makeRenderer(*context, scene, {.width = 96, .height = 54});
  ASSERT_TRUE(renderer->setDebugView(DebugView::Steps).ok());
  renderer->frame(sideways(0, 500));
  EXPECT_GT(residentMiB(), before + 400);
  renderer.reset();
  EXPECT_LT(residentMiB(), before + 200) << "heaps keep pages, of the CPU's mirror for instance, which is a quarter at most";
}

TEST_F(Budget, TooLittleIsOneLineThatSaysHowMuchIsEnough) {
  Scene scene = smallEarth();
  const auto least = leastBudget(*context, scene);
  ASSERT_TRUE(least.ok());
  scene.quality.budget_bytes = *least;
  {
    const auto renderer = makeRenderer(*context, scene, {.width = 96, .height = 54});
    ASSERT_NE(renderer, nullptr) << "the least budget works";
    const FrameStats stats = renderer->frame(sideways(0, 0));
    EXPECT_LE(stats.bytesUsed, *least);
    EXPECT_EQ(stats.counters.nanPixels, 0u);
  }
  // leastBudget() rounds up to whole MiB, so one less is too little; then so little that not even the air's tables fit.
  for (const std::uint64_t budget : {*least - kMiB, kMiB}) {
    scene.quality.budget_bytes = budget;
    const auto made = Renderer::create(*context, scene, {.width = 96, .height = 54});
    ASSERT_FALSE(made.ok()) << budget;
    EXPECT_THAT(made.error().message, testing::HasSubstr("budget"));
    EXPECT_EQ(made.error().message.find('\n'), std::string::npos);
    if (budget == kMiB) continue;
    EXPECT_THAT(made.error().message, testing::HasSubstr(std::to_string(*least / kMiB) + " MiB"));
  }
}

std::set<std::string> names(const Renderer& renderer) {
  std::set<std::string> all;
  for (const auto& [name, bytes] : renderer.memory().byName()) all.insert(name);
  return all;
}

// Draws ground, horizon and sky of a scene that lacks something; returns what memory it took.
std::set<std::string> drawn(gpu::Context& context, const Scene& scene, double leastContrast) {
  const auto renderer = makeRenderer(context, scene, {.width = 96, .height = 54});
  if (!renderer) return {};
  renderer->settle(viewAt(45, 0, 9000, 0, -12));
  for (const View& view : {viewAt(45, 0, 9000, 0, -12), viewAt(45, 0, 9000, 0, -12), viewAt(45, 0, 2e6, 0, -50)}) {
    const FrameStats stats = renderer->frame(view);
    EXPECT_EQ(stats.counters.nanPixels, 0u);
    for (const float v : renderer->radiance().rgba) EXPECT_TRUE(std::isfinite(v) && v >= 0);
    EXPECT_EQ(stats.counters.marchedPixels > 0, scene.clouds.has_value());
  }
  EXPECT_GE(contrast(renderer->image()), leastContrast);
  return names(*renderer);
}

TEST_F(Budget, WhatASceneLeavesOutTakesNoMemory) {
  const std::set<std::string> always{"camera block", "counters", "picture"};
  Scene scene = bareBall();
  EXPECT_EQ(drawn(*context, scene, 0), always) << "a black ball";
  scene.sun = smallEarth().sun;
  EXPECT_EQ(drawn(*context, scene, 0.05), always) << "a ball in sunlight";
  scene.atmosphere = smallEarth().atmosphere;
  std::set<std::string> withAir = always;
  withAir.insert("sky");
  EXPECT_EQ(drawn(*context, scene, 0.05), withAir);
  scene.sun.reset();
  EXPECT_EQ(drawn(*context, scene, 0), always) << "air without light";

  scene = quickEarth();
  const auto everything = drawn(*context, scene, 0.05);
  EXPECT_TRUE(everything.contains("sky") && everything.contains("bricks") && everything.contains("cloud history"));
  scene.atmosphere.reset();
  std::set<std::string> noAir = everything;
  noAir.erase("sky");
  EXPECT_EQ(drawn(*context, scene, 0.05), noAir);
  scene.sun.reset();
  EXPECT_EQ(drawn(*context, scene, 0), noAir) << "clouds at night";
}

}  // namespace
}  // namespace welkin
