#pragma once
// Adaptive Gauss-Kronrod quadrature of three-component integrands.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <vector>

namespace welkin::reference {

struct Tolerance {
  double relative, absolute;  // the integral is done when each component's error is below the greater of both
};

struct Integral {
  glm::dvec3 value{}, error{};  // estimate of the error, pessimistic
  bool converged = true;
};

// Nodes x > 0 with their Kronrod weights, from the outermost inwards, then those of x = 0; the Gauss rule has every second node.
// Values: QUADPACK (Piessens et al. 1983).
struct Kronrod15 {
  static constexpr std::array<double, 8> node{0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                                              0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                                              0.586087235467691130294144691258380, 0.405845151377397166906606412076961,
                                              0.207784955007898467600689403773245, 0};
  static constexpr std::array<double, 8> weight{0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
                                                0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
                                                0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
                                                0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
  static constexpr std::array<double, 4> gauss{0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
                                               0.381830050505118944950369775488975, 0.417959183673469387755102040816327};
};
namespace detail {

struct Panel {
  double from, to;
  glm::dvec3 value, error;
};

// Value, and the error as QUADPACK estimates it from the difference to the Gauss rule.
template <class Rule, class Function>
Panel panel(Function&& f, double from, double to) {
  constexpr std::size_t n = Rule::node.size();
  const double centre = 0.5 * (from + to), half = 0.5 * (to - from);
  std::array<glm::dvec3, 2 * n - 1> values;
  values[n - 1] = f(centre);
  glm::dvec3 kronrod = values[n - 1] * Rule::weight[n - 1], size = glm::abs(kronrod);
  glm::dvec3 gauss{};
  if constexpr (n % 2 == 0) gauss = values[n - 1] * Rule::gauss[n / 2 - 1];
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const glm::dvec3 low = f(centre - half * Rule::node[i]), high = f(centre + half * Rule::node[i]);
    values[i] = low, values[2 * n - 2 - i] = high;
    kronrod += (low + high) * Rule::weight[i];
    size += (glm::abs(low) + glm::abs(high)) * Rule::weight[i];
    if (i % 2 == 1) gauss += (low + high) * Rule::gauss[i / 2];
  }
  glm::dvec3 spread{};  // of the integrand about its mean
  for (std::size_t i = 0; i < 2 * n - 1; ++i) spread += glm::abs(values[i] - 0.5 * kronrod) * Rule::weight[i < n ? i : 2 * n - 2 - i];
  Panel out{from, to, kronrod * half, {}};
  for (int k = 0; k < 3; ++k) {
    double error = std::abs(kronrod[k] - gauss[k]);
    if (spread[k] > 0) error = std::min(error, spread[k] * std::pow(200 * error / spread[k], 1.5));
    // Below this a difference is rounding of the sums.
    if (error <= 50 * std::numeric_limits<double>::epsilon() * size[k]) error = 0;
    out.error[k] = error * half;
  }
  return out;
}

}  // namespace detail

// Integral of f over [breaks.front(), breaks.back()], which ascends: f should be smooth between breaks. The panel with the greatest
// error is halved until the tolerance is kept; not converged after `most` panels. Nothing to integrate (one break): 0.
template <class Rule = Kronrod15, class Function>
Integral integrate(Function&& f, std::span<const double> breaks, Tolerance tolerance, std::size_t most = 2000) {
  Integral sum;
  std::vector<detail::Panel> panels;
  panels.reserve(breaks.size() + 8);
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    if (breaks[i + 1] > breaks[i]) panels.push_back(detail::panel<Rule>(f, breaks[i], breaks[i + 1]));
  while (true) {
    sum.value = sum.error = glm::dvec3(0);
    for (const auto& p : panels) sum.value += p.value, sum.error += p.error;
    const glm::dvec3 allowed = glm::max(glm::abs(sum.value) * tolerance.relative, glm::dvec3(tolerance.absolute));
    const auto excess = [&](const detail::Panel& p) {
      const glm::dvec3 e = p.error / allowed;
      return std::max({e.x, e.y, e.z});
    };
    if (glm::all(glm::lessThanEqual(sum.error, allowed))) return sum;
    if (panels.size() >= most) break;
    auto worst = std::max_element(panels.begin(), panels.end(), [&](const auto& a, const auto& b) { return excess(a) < excess(b); });
    const double middle = 0.5 * (worst->from + worst->to);
    if (!(middle > worst->from && middle < worst->to)) break;
    const detail::Panel right = detail::panel<Rule>(f, middle, worst->to);
    *worst = detail::panel<Rule>(f, worst->from, middle);
    panels.push_back(right);
  }
  sum.converged = false;
  return sum;
}

}  // namespace welkin::reference
