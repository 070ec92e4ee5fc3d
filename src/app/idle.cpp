#include "idle.h"

#include <chrono>
#include <thread>

#include "welkin/gpu/timer.h"

namespace welkin::app {
namespace {

constexpr double kLook_ms = 2;       // how long the process is watched,
constexpr double kIdleCpu_ms = 0.3;  // and the CPU time below which its threads count as idle: the watching itself costs 0.05
constexpr int kMostLooks = 5000;     // 10 s: selection takes milliseconds

}  // namespace

void waitUntilIdle() {
  for (int i = 0; i < kMostLooks; ++i) {
    const double before = gpu::processCpu_ms();
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(kLook_ms));
    if (gpu::processCpu_ms() - before < kIdleCpu_ms) return;
  }
}

}  // namespace welkin::app
