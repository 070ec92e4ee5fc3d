#include "welkin/physics/quadrature.h"

#include <cmath>
#include <numbers>

namespace welkin {

std::vector<QuadratureNode> gaussLegendre(int n) {
  std::vector<QuadratureNode> nodes(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int turn = 0; turn < 8; ++turn) {  // quadratic convergence: 5 turns reach the last bit
      double before = 1, now = x;
      for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
        before = now, now = next;
      }
      slope = n * (x * now - before) / (x * x - 1);
      x -= now / slope;
    }
    nodes[static_cast<std::size_t>(i)] = {(1 + x) / 2, 1 / ((1 - x * x) * slope * slope)};
  }
  return nodes;
}

}  // namespace welkin
