#include "welkin/measure/statistics.h"

#include <algorithm>
#include <cmath>

namespace welkin::measure {

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  const double rank = std::clamp(q, 0.0, 1.0) * double(values.size() - 1);
  const auto low = static_cast<std::size_t>(rank);
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(low), values.end());
  const double a = values[low];
  if (low + 1 == values.size()) return a;
  const double b = *std::min_element(values.begin() + std::ptrdiff_t(low) + 1, values.end());
  return a + (b - a) * (rank - double(low));
}

Summary summarize(const std::vector<double>& values) {
  Summary s;
  s.n = values.size();
  if (values.empty()) return s;
  s.median = quantile(values, 0.5);
  s.p95 = quantile(values, 0.95);
  s.max = *std::max_element(values.begin(), values.end());
  for (const double v : values) s.total += v;
  s.mean = s.total / double(s.n);
  return s;
}

Spread spreadOf(const std::vector<double>& values) {
  return {quantile(values, 0.5), quantile(values, 0.25), quantile(values, 0.75), values.size()};
}

}  // namespace welkin::measure
