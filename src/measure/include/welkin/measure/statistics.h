#pragma once
// Summaries of a series of numbers.
#include <cstddef>
#include <vector>

namespace welkin::measure {

struct Summary {
  std::size_t n = 0;
  double median = 0, p95 = 0, max = 0, mean = 0, total = 0;  // 0 when n is 0
};

Summary summarize(const std::vector<double>& values);

struct Spread {  // of repetitions: the median, and the quartiles that half of them lie between
  double median = 0, p25 = 0, p75 = 0;
  std::size_t n = 0;
};
Spread spreadOf(const std::vector<double>& values);

// Quantile q in 0..1 of values (any order), linear between ranks (Hyndman and Fan, type 7). 0 for an empty list.
double quantile(std::vector<double> values, double q);

}  // namespace welkin::measure
