#pragma once
// Gauss-Legendre quadrature on [0, 1].
#include <vector>

namespace welkin {

struct QuadratureNode { double x, weight; };

// n nodes, ascending, weights adding up to 1: exact for polynomials up to degree 2n - 1. Newton's method on the Legendre polynomial from the
// usual cosine guess.
std::vector<QuadratureNode> gaussLegendre(int n);

}  // namespace welkin
