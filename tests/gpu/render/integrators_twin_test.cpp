// The integrators on the GPU against the same code compiled as C++, for optical depths from 1e-8 to 1e8.
#include <cstdio>

#include "random32.h"
#include "twins.h"
#include "welkin/shared/integrators.glsl.h"

namespace welkin {
namespace {
using namespace test;
using namespace shared;
using IntegratorTwins = Twins;

struct Row {
  glm::vec4 extinction_per_m, other;
};
constexpr std::size_t kRows = 10240, kPerRow = 74;

// + - x and / agree to a few units in the last place. exp2 may be off by 2 + 2 |x| units of its result on a GPU (Vulkan's rule; GLSL 4.5
// gives none), x its argument: that is 3e-7 (1 + |x|), and where the result has fallen below 1e-9 of what it is added to nobody sees it.
double allowed(double depth) { return 3e-7 * (4 + 1.45 * std::min(depth, 25.0)); }

TEST_F(IntegratorTwins, GainsOfEveryRule) {
  Random32 random(20261123);
  const auto unit = [&] { return float(random() >> 8) * 0x1p-24f; };
  std::vector<Row> rows(kRows);
  for (Row& row : rows) {
    const float length = std::exp2(20 * (unit() - 0.5f)), depth = std::pow(10.0f, -8 + 16 * unit()), spread = 8 * unit();
    for (int i = 0; i < 4; ++i) {
      row.extinction_per_m[i] = random() % 16 == 0 ? 0 : std::min(depth * std::pow(10.0f, spread * (unit() - 0.5f)), 1e8f) / length;
      if (random() % 16 == 0) row.extinction_per_m = glm::vec4(row.extinction_per_m[i]);
    }
    row.other = {length, random() % 64 == 0 ? 0 : std::pow(10.0f, -8 + 16 * unit()), 0, 0};
  }
  const auto answers = run<float>("integrators_twin.comp", rows, kPerRow);
  double worst[kIntegrators + 1] = {};
  for (std::size_t i = 0; i < kRows; ++i) {
    const float* gpu = &answers[kPerRow * i];
    const vec4 x = rows[i].extinction_per_m * rows[i].other.x;
    const double depth = std::max({x.x, x.y, x.z, x.w});
    const float tau = rows[i].other.y;
    // Difference over what is allowed. `size`: what the value is a part of.
    const auto compare = [&](std::size_t what, float cpu, double size, double of) {
      const float v = *gpu++;
      ASSERT_TRUE(std::isfinite(v)) << "row " << i << ", rule " << what;
      worst[what] = std::max(worst[what], std::abs(double(v) - cpu) / (size * allowed(of)));
    };
    for (uint rule = 0; rule < kIntegrators; ++rule) {
      const SegmentGains g = segmentGains(rule, rows[i].extinction_per_m, rows[i].other.x);
      const float largest = std::max({g.gain.x, g.gain.y, g.gain.z, g.gain.w, 1e-30f});
      compare(rule, g.transmittance, 1, std::min(depth, 1.0));  // an error of exp2 is x e^-x: 0.37 units at most
      for (int k = 0; k < 4; ++k) compare(rule, g.gain[k], largest, depth);
      const float coarse = std::max({g.coarse.x, g.coarse.y, g.coarse.z, g.coarse.w, 1e-30f});
      for (int k = 0; k < 4; ++k) compare(rule, g.coarse[k], coarse, depth);
      compare(rule, gainExcess(rule, tau), std::max(gainExcess(rule, tau), 1.0f), tau);
    }
    compare(kIntegrators, opacityOf(tau), opacityOf(tau) + 1e-30, tau);
    compare(kIntegrators, transmittanceOf(tau), 1, std::min(tau, 1.0f));
    compare(kIntegrators, emissionDepth(tau), emissionDepth(tau), 0);
  }
  std::printf("greatest difference over what is allowed:");
  for (const double w : worst) {
    std::printf(" %.3f", w);
    EXPECT_LE(w, 1);
  }
  std::printf("\n");
}

}  // namespace
}  // namespace welkin
