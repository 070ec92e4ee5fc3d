#include <gtest/gtest.h>

#include <cmath>

#include "welkin/physics/air.h"
#include "welkin/physics/quadrature.h"

namespace welkin {
namespace {

// n nodes integrate x^k over [0, 1] exactly up to k = 2n - 1, and not x^2n.
TEST(Quadrature, ExactUpToItsDegree) {
  for (int n = 1; n <= 20; ++n) {
    const auto integral = [&](int k) {
      double sum = 0;
      for (const auto& node : gaussLegendre(n)) sum += node.weight * std::pow(node.x, k);
      return sum;
    };
    for (int k = 0; k < 2 * n; ++k) EXPECT_NEAR(integral(k), 1.0 / (k + 1), 1e-14) << n << " " << k;  // some roundings of doubles
    if (n >= 8) continue;  // the error falls as 16^-n
    EXPECT_GT(std::abs(integral(2 * n) - 1.0 / (2 * n + 1)), 1e-11) << n;
  }
}

// Moments of a phase function against their integral, chi_l = integral of p P_l, by Gauss nodes: 64 of them hold g = 0.8 to 1e-9.
TEST(Quadrature, MomentsOfPhaseFunctions) {
  for (const auto& [type, g] : {std::pair{PhaseType::Rayleigh, 0.0}, {PhaseType::Isotropic, 0.0}, {PhaseType::HenyeyGreenstein, 0.7},
                                {PhaseType::HenyeyGreenstein, -0.5}, {PhaseType::CornetteShanks, 0.8}}) {
    Scene scene;
    scene.atmosphere = Atmosphere{100'000, "auto", {{"air", ExponentialProfile{8000}, {1e-5, 1e-5, 1e-5}, {}, type, g}}};
    const auto block = airBlock(scene, 12);
    ASSERT_TRUE(block.ok());
    const shared::AirLayer& layer = block->layers[0];
    double moments[16] = {};
    for (const auto& node : gaussLegendre(64)) {
      const double c = 2 * node.x - 1;
      double before = 1, now = c;
      const double p = 4 * 3.14159265358979 * node.weight * shared::phaseValue(layer.phase, layer.g, float(c));
      moments[0] += p, moments[1] += p * c;
      for (int l = 2; l < 16; ++l) {
        const double next = ((2 * l - 1) * c * now - (l - 1) * before) / l;
        before = now, now = next;
        moments[l] += p * now;
      }
    }
    for (int l = 0; l < 16; ++l) EXPECT_NEAR(layer.moments[l / 4][l % 4], moments[l], 2e-6) << "phase functions are floats; g " << g << " l " << l;
    EXPECT_NEAR(layer.forward, std::max(moments[13], 0.0), 2e-6);
    EXPECT_EQ(airBlock(scene)->layers[0].forward, 0) << "without a degree extinction is physical";
  }
}

}  // namespace
}  // namespace welkin
