#pragma once
// Random numbers of a path: the first few from a lattice, which fills their space evenly, the others independent.
#include <array>
#include <cmath>
#include <cstdint>

namespace welkin::reference {

// SplitMix64 (Steele, Lea and Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ull);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
    return z ^ (z >> 31);
  }
  double unit() { return double(bits() >> 11) * 0x1p-53; }  // [0, 1)

 private:
  std::uint64_t state_;
};

// A seed from two, so that neighbours have nothing in common.
inline std::uint64_t mixSeeds(std::uint64_t a, std::uint64_t b) { return Random(Random(a).bits() ^ (b * 0xD1342543DE82EF95ull)).bits(); }

// The numbers of path `index` of a batch: kLattice of them from an additive lattice that is shifted at random once a batch (Cranley and
// Patterson 1976), whose steps are powers of the root of x^(d+1) = x + 1 (Roberts 2018). Each is uniform, so that every path is unbiased;
// together they are even, so that a batch errs less. The error is known from independent batches only.
class PathNumbers {
 public:
  static constexpr int kLattice = 8;
  struct Shift {
    explicit Shift(Random& random) {
      for (double& s : shift) s = random.unit();
    }
    std::array<double, kLattice> shift;
  };

  PathNumbers(const Shift& shift, std::uint64_t index, Random& random) : shift_(shift), index_(index), random_(random) {}
  double next() {
    if (used_ >= kLattice) return random_.unit();
    const double x = shift_.shift[used_] + double(index_) * step(used_);
    ++used_;
    return x - std::floor(x);
  }
  double plain() { return random_.unit(); }

 private:
  static double step(int i) {
    static const auto steps = [] {
      double root = 1;
      for (int k = 0; k < 100; ++k) root = std::pow(1 + root, 1.0 / (kLattice + 1));
      std::array<double, kLattice> out{};
      double power = 1;
      for (double& s : out) s = power /= root;
      return out;
    }();
    return steps[i];
  }
  const Shift& shift_;
  std::uint64_t index_;
  Random& random_;
  int used_ = 0;
};

}  // namespace welkin::reference
