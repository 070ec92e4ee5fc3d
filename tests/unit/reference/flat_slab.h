#pragma once
#include <cmath>
#include <vector>

#include "media.h"

namespace welkin::reference {

// A flat slab of isotropic scatterers over a Lambert ground under a point sun: J = J_sun + (albedo / 2) (int E1(|t - t'|) J(t') dt' + E2(T
// - t) I_g) (Chandrasekhar 1960) by cells of even J, whose kernels are differences of E2; iterated until nothing changes.
class FlatSlab {
 public:
  FlatSlab(double depth, double albedo, double ground, double mu0) : depth_(depth), mu0_(mu0), step_(depth / kCells), source_(kCells) {
    std::vector<double> first(kCells), last;
    for (int i = 0; i < kCells; ++i)  // the cell's mean
      first[i] = albedo / (4 * kPi) * mu0 / step_ * (std::exp(-i * step_ / mu0) - std::exp(-(i + 1) * step_ / mu0));
    std::vector<double> kernel(kCells), down(kCells);
    for (int i = 0; i < kCells; ++i) {
      kernel[i] = i == 0 ? 2 * (1 - e2(step_ / 2)) : e2((i - 0.5) * step_) - e2((i + 0.5) * step_);
      down[i] = e3(depth - (i + 1) * step_) - e3(depth - i * step_);
    }
    source_ = first;
    double change = 1;
    while (change > 1e-12) {
      double flux = mu0 * std::exp(-depth / mu0);
      for (int i = 0; i < kCells; ++i) flux += 2 * kPi * down[i] * source_[i];
      groundRadiance_ = ground / kPi * flux;
      last = source_, change = 0;
      for (int i = 0; i < kCells; ++i) {
        double sum = e2(depth - (i + 0.5) * step_) * groundRadiance_;
        for (int j = 0; j < kCells; ++j) sum += kernel[std::abs(i - j)] * source_[j];
        source_[i] = first[i] + albedo / 2 * sum;
        change = std::max(change, std::abs(source_[i] - last[i]) / first[0]);
      }
    }
  }
  double up(double mu) const { return along(mu, true) + groundRadiance_ * std::exp(-depth_ / mu); }  // at the top, upwards
  double down(double mu) const { return along(mu, false); }                                          // at the ground, downwards

 private:
  static constexpr int kCells = 300;
  static double e1(double x) { return -std::expint(-x); }
  static double e2(double x) { return x > 0 ? std::exp(-x) - x * e1(x) : 1; }
  static double e3(double x) { return 0.5 * (std::exp(-x) - x * e2(x)); }
  double along(double mu, bool upwards) const {
    double sum = 0;
    for (int i = 0; i < kCells; ++i) {
      const double near = upwards ? i * step_ : depth_ - (i + 1) * step_;
      sum += source_[i] * (std::exp(-near / mu) - std::exp(-(near + step_) / mu));
    }
    return sum;
  }
  double depth_, mu0_, step_, groundRadiance_ = 0;
  std::vector<double> source_;
};

}  // namespace welkin::reference
