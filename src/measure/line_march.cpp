#include "welkin/measure/line_march.h"

#include <algorithm>
#include <cmath>

#include "welkin/reference/quadrature.h"

namespace welkin::measure {
namespace {

using shared::SegmentGains, shared::uint, shared::vec4;

struct Samples {
  vec4 extinction_per_m{0}, source{0};
};
// At the rule's nodes of a segment; nodes that it has not are copies of the last.
Samples sampled(const Line& line, uint rule, double from_m, double length_m) {
  Samples out;
  const uint nodes = shared::integratorNodes(rule);
  for (uint i = 0; i < 4; ++i) {
    const double s = std::min(from_m + shared::integratorNode(rule, std::min(i, nodes - 1)) * length_m, line.length_m);
    out.extinction_per_m[int(i)] = i < nodes ? float(line.extinction_per_m(s)) : out.extinction_per_m[int(nodes - 1)];
    out.source[int(i)] = i < nodes ? float(line.source(s)) : out.source[int(nodes - 1)];
  }
  return out;
}

// Each smooth piece in panels that halve towards both its ends: what a thick medium sends comes from a thin layer behind a piece's front.
std::vector<double> ladder(const Line& line) {
  constexpr int kRungs = 44;
  std::vector<double> ends{0}, out{0};
  ends.insert(ends.end(), line.breaks_m.begin(), line.breaks_m.end());
  ends.push_back(line.length_m);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double a = ends[i], w = ends[i + 1] - a;
    for (int k = kRungs; k >= 1; --k) out.push_back(a + w * std::ldexp(1.0, -k));
    for (int k = 2; k <= 4; ++k) out.push_back(ends[i + 1] - w * std::ldexp(1.0, -k));
    out.push_back(ends[i + 1]);
  }
  return out;
}

double depthTo(const Line& line, double s) {
  if (line.depth) return line.depth(s);
  std::vector<double> breaks{0};
  for (const double b : line.breaks_m)
    if (b < s) breaks.push_back(b);
  breaks.push_back(s);
  return reference::integrate([&](double t) { return glm::dvec3(line.extinction_per_m(t), 0, 0); }, breaks, {1e-11, 1e-16}).value.x;
}

}  // namespace

LineLight marchLine(const Line& line, Integrator rule, int segments, GainsRule gains) {
  const uint id = uint(rule);
  float light = 0, transmittance = 1, before = 0;
  for (int i = 0; i < segments; ++i) {
    const double from = line.length_m * i / segments, length = line.length_m / segments;
    Samples at = sampled(line, id, from, length);
    if (rule == Integrator::ExponentialLinear) {
      const float here = at.source.x;
      at.source.y = i == 0 ? here : before;
      before = here;
    }
    const SegmentGains g = gains(id, at.extinction_per_m, float(length));
    light += transmittance * glm::dot(g.gain, at.source);
    transmittance *= g.transmittance;
  }
  return {light, transmittance, segments};
}

LineLight marchLineAdaptive(const Line& line, double tolerance, GainsRule gains) {
  constexpr double kRounding = 2e-7;  // of two sums of a few terms of up to 1
  constexpr float kHidden = 1e-7f;
  const uint id = uint(Integrator::Adaptive);
  float light = 0, transmittance = 1;
  double at_m = 0, step_m = line.length_m / 8;
  LineLight out;
  while (at_m < line.length_m && transmittance > kHidden) {
    const double left = line.length_m - at_m, length = std::min(step_m, left);
    const Samples at = sampled(line, id, at_m, length);
    const SegmentGains g = gains(id, at.extinction_per_m, float(length));
    const double error = transmittance * shared::segmentError(g, at.extinction_per_m, at.source);
    const double opacity = transmittance * (1 - g.transmittance);
    const double allowed = tolerance * 0.5 * (length / line.length_m + opacity) + kRounding * transmittance;
    const double better = 0.9 * std::sqrt(allowed / std::max(error, 1e-12));  // the coarse estimate's error goes with the step squared
    if (error > allowed) {
      step_m = length * std::clamp(better, 0.1, 0.5);
      continue;
    }
    light += transmittance * glm::dot(g.gain, at.source);
    transmittance *= g.transmittance;
    at_m = length < left ? at_m + length : line.length_m;
    step_m = length * std::clamp(better, 0.5, 2.0);
    ++out.segments;
  }
  out.radiance = light, out.transmittance = transmittance;
  return out;
}

LineLight exactLine(const Line& line) {
  const auto panels = ladder(line);
  const auto light = [&](double s) { return glm::dvec3(line.extinction_per_m(s) * line.source(s) * std::exp(-depthTo(line, s)), 0, 0); };
  const auto radiance = reference::integrate(light, panels, {1e-10, 1e-14}, 20000);
  return {radiance.converged ? radiance.value.x : std::nan(""), std::exp(-depthTo(line, line.length_m)), 0};
}

double relativeError(const LineLight& marched, const LineLight& exact) {
  const double most = exact.transmittance > 0 ? -std::expm1(std::log(exact.transmittance)) : 1;
  const double difference = std::abs(marched.radiance - exact.radiance);
  return difference == 0 ? 0 : difference / most;
}

Order observedOrder(const std::vector<Line>& family, Integrator rule, GainsRule gains) {
  constexpr double kAsymptotic = 0.01, kRounding = 6e-8;
  std::vector<LineLight> truths;
  for (const Line& line : family) truths.push_back(exactLine(line));
  Order out;
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (int segments = 2; segments <= 4096; segments += segments & (segments - 1) ? segments / 3 : segments / 2) {  // 2, 3, 4, 6, 8, 12 ...
    double squares = 0;
    for (std::size_t i = 0; i < family.size(); ++i) {
      const double error = relativeError(marchLine(family[i], rule, segments, gains), truths[i]);
      squares += error * error;
      out.greatestError = std::max(out.greatestError, error);
    }
    const double error = std::sqrt(squares / double(family.size()));
    out.greatestPerStep = std::max(out.greatestPerStep, error * segments);
    if (!(error > kRounding * std::max(20.0, 0.5 * segments) && error < kAsymptotic)) continue;
    const double h = -std::log(double(segments)), e = std::log(error);
    n += 1, x += h, y += e, xx += h * h, xy += h * e;
  }
  out.counts = int(n);
  if (n > 1) out.slope = (n * xy - x * y) / (n * xx - x * x);
  return out;
}

std::vector<OrderLines> orderLines() {
  constexpr int kFamily = 12;
  std::vector<OrderLines> out;
  const auto family = [&](const char* name, bool stiff, auto&& member) {
    OrderLines lines{name, stiff, {}};
    for (int i = 0; i < kFamily; ++i) lines.family.push_back(member((i + 0.5) / kFamily));
    out.push_back(std::move(lines));
  };
  const auto waves = [](double p) { return [p](double s) { return 0.5 + 0.4 * std::cos(3 * s + 6.28 * p); }; };
  const auto fading = [](double p) { return [p](double s) { return std::exp(-(0.5 + p) * s); }; };
  family("exponential", false, [&](double p) {
    const double a = 2.5 + p, k = 1 + p;
    return Line{1, [=](double s) { return a * std::exp(-k * s); }, waves(p), [=](double s) { return -a / k * std::expm1(-k * s); }, {}};
  });
  family("gaussian", false, [&](double p) {
    const double c = p, w = 0.4;
    return Line{1,
                [=](double s) { return 4 * std::exp(-std::pow((s - c) / w, 2)); },
                fading(p),
                [=](double s) { return 2 * w * std::sqrt(M_PI) * (std::erf((s - c) / w) + std::erf(c / w)); },
                {}};
  });
  const auto sinusoid = [&](double depth) {
    return [=](double p) {
      const double f = 6.28 * p;
      return Line{1,
                  [=](double s) { return depth * (1 + 0.8 * std::sin(5 * s + f)); },
                  waves(p),
                  [=](double s) { return depth * (s + 0.16 * (std::cos(f) - std::cos(5 * s + f))); },
                  {}};
    };
  };
  family("sinusoid", false, sinusoid(2.5));
  for (const auto& [name, sigma] :
       {std::pair{"even, depth 1e-3", 1e-3}, {"even, depth 30", 30.0}, {"even, depth 1e4", 1e4}, {"even, depth 1e7", 1e7}}) {
    family(name, true, [&, s0 = sigma](double p) {
      return Line{1, [=](double) { return s0; }, fading(p), [=](double s) { return s0 * s; }, {}};
    });
  }
  family("sinusoid, depth 1e6", true, sinusoid(1e6));
  return out;
}

double promisedOrder(Integrator rule, bool stiff) {
  const bool exponential = rule >= Integrator::ExponentialConstant;
  if (exponential) return 1;
  if (stiff) return 0;
  return rule == Integrator::Rectangle ? 1 : rule == Integrator::Trapezoid ? 2 : 4;
}

std::vector<OrderCheck> checkOrders(GainsRule gains) {
  std::vector<OrderCheck> out;
  for (const OrderLines& l : orderLines()) {
    for (std::size_t i = 0; i < kIntegratorNames.size(); ++i) {
      const auto rule = Integrator(i);
      const double promised = promisedOrder(rule, l.stiff);
      if (promised == 0) continue;
      OrderCheck check{l.name, rule, promised, observedOrder(l.family, rule, gains), false};
      // First order means an error of at most a constant times the step. The sources' slopes are about 1, so the first neglected term of a
      // first order rule is half a step: a rule that stays below a twentieth of it keeps the promise, however the rest goes.
      const bool far_below = promised == 1 && check.observed.greatestPerStep < 0.025;
      check.ok = far_below || (check.observed.counts >= 3 && check.observed.slope >= promised - kOrderSlack);
      out.push_back(check);
    }
  }
  return out;
}

}  // namespace welkin::measure
