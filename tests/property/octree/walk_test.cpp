// The walk of shared/walk.glsl.h against brute force: random trees, a million rays, grazing and axis-parallel ones included.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "welkin/shared/walk.glsl.h"

namespace welkin {
namespace {

using namespace shared;

// A random tree: which nodes are split is a hash of their address, so no storage is needed.
struct RandomTree {
  std::uint32_t seed, depth;
  bool split(glm::uvec3 corner, std::uint32_t level) const {
    std::uint64_t h = seed * 0x9E3779B97F4A7C15ull ^ (std::uint64_t{corner.x} << 32 | corner.y) * 0xBF58476D1CE4E5B9ull ^
                      (std::uint64_t{corner.z} << 8 | level) * 0x94D049BB133111EBull;
    h ^= h >> 29;
    h *= 0xD6E8FEB86659FD93ull;
    return level < depth && (level < 6 || ((h >> 40) % 100) < 60);
  }
  std::uint32_t leafLevel(glm::uvec3 p) const {
    std::uint32_t level = 0;
    while (split(nodeCorner(p, level), level)) ++level;
    return level;
  }
};

double outside(double x, double low, double high) { return std::max({low - x, x - high, 0.0}); }

TEST(Walk, IntervalsAbutAndNothingIsSkipped) {
  const std::uint32_t seed = 20260101;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal;
  constexpr int kTrees = 50, kRays = 20'000;  // one million rays
  constexpr double kHalf_m = 6.4e6, kStep_m = kHalf_m * 0x1p-31;
  std::uint64_t cells = 0;
  for (int t = 0; t < kTrees; ++t) {
    const RandomTree tree{std::uint32_t(random()), std::uint32_t(6 + random() % 14)};
    for (int r = 0; r < kRays; ++r) {
      glm::dvec3 start{unit(random), unit(random), unit(random)};
      start *= 4294967295.0;
      glm::dvec3 d{normal(random), normal(random), normal(random)};
      if (r % 8 == 0) d[r / 8 % 3] = 0;                                             // in a plane of the grid
      if (r % 16 == 1) d[(r / 16 + 1) % 3] = d[(r / 16 + 2) % 3] = 0;               // along an axis
      if (r % 8 == 2) d[r / 8 % 3] *= 1e-6;                                         // grazing faces
      if (r % 32 == 3) start[r / 32 % 3] = std::floor(unit(random) * 64) * 0x1p26;  // on a face of the grid
      if (glm::length(d) == 0) d.x = 1;
      const glm::vec3 dir(glm::normalize(d));
      const Walk walk = startWalk(start, dir, float(1 / kStep_m));
      const float length = float(std::pow(10.0, 2 + 4 * unit(random)));
      float at = 0;
      for (int n = 0; at < length; ++n) {
        ASSERT_LT(n, 200'000) << "the walk does not advance; seed " << seed;
        const glm::uvec3 p = walkTo(walk, at);
        const std::uint32_t level = tree.leafLevel(p);
        const float next = std::min(at + leaveNode(walk, nodeSteps(p, level), levelSteps(level), at, float(kStep_m)), length);
        ASSERT_GT(next, at) << "an empty interval; seed " << seed;
        // Every point of the interval lies in the node, to the error that the walk states. Outside the root: positions wrap, stop.
        const glm::uvec3 low = nodeCorner(p, level);
        const double size = std::ldexp(1.0, 32 - int(level));
        bool left = false;
        for (const double share : {0.0, 0.37, 1.0}) {
          const double s = double(at) + share * (double(next) - double(at));
          const glm::dvec3 x = start + glm::dvec3(dir) * (s / kStep_m);
          for (int a = 0; a < 3; ++a) {
            // the walk's own error at both ends, the way past the exit, and the place in a large node, which a float rounds
            const double slack = 4 * walkError(next, float(kStep_m)) / kStep_m + size * 0x1p-23;
            left = left || x[a] < slack || x[a] >= 4294967296.0 - slack;  // positions wrap at the root's faces
            if (left) continue;
            ASSERT_LE(outside(x[a], low[a], low[a] + size), slack)
                << "seed " << seed << " tree " << t << " ray " << r << " axis " << a << " level " << level;
          }
        }
        ++cells;
        if (left) break;
        at = next;
      }
    }
  }
  EXPECT_GT(cells, 3u * kTrees * kRays);  // the rays did meet trees
}

// A ray that starts on a face, an edge or a corner and hardly leaves it goes on from node to node: what it does not move across a face it
// need not be looked up for. Even nodes of 1.5 km; the renderer gives up after 4096 look-ups.
TEST(Walk, RaysInAFaceTakeOneVisitANode) {
  constexpr double kHalf_m = 6.4e6, kStep_m = kHalf_m * 0x1p-31, kLength_m = 400e3;
  constexpr std::uint32_t kLevel = 13;
  const double node_m = std::ldexp(kStep_m, 32 - int(kLevel));
  for (int along = 0; along < 3; ++along) {
    for (const double y : {0.0, 1e-17, -1e-17, 1e-12, -1e-12, 1e-9, -1e-9, 1e-7, -1e-7, 1e-5, -1e-5}) {
      for (const double z : {0.0, -1e-17, -1e-8, 1e-8, 0.3, -0.3}) {
        for (const double off : {0.0, -1.0, 1.0, 2.0}) {  // steps from the face
          glm::dvec3 d, start(0x1p31);
          d[along] = 1, d[(along + 1) % 3] = y, d[(along + 2) % 3] = z;
          start[(along + 1) % 3] += off;
          const glm::vec3 dir(glm::normalize(d));
          const Walk walk = startWalk(start, dir, float(1 / kStep_m));
          int visits = 0;
          for (float at = 0; at < kLength_m && visits < 100'000; ++visits) {
            const glm::uvec3 p = walkTo(walk, at);
            at += leaveNode(walk, nodeSteps(p, kLevel), levelSteps(kLevel), at, float(kStep_m));
          }
          const double crossed = kLength_m / node_m * (std::abs(dir.x) + std::abs(dir.y) + std::abs(dir.z));
          EXPECT_LE(visits, crossed + 8) << "direction " << dir.x << " " << dir.y << " " << dir.z << ", " << off << " steps off";
        }
      }
    }
  }
}

}  // namespace
}  // namespace welkin
