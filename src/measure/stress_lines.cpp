#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "welkin/measure/stress.h"
#include "welkin/shared/camera.glsl.h"

namespace welkin::measure {
namespace {

constexpr int kSegments = 64;
constexpr double kFurnaceSlack = 1e-5;  // 64 segments, each of up to two roundings of 6e-8
constexpr double kEarthCloud_per_m = 0.05;

// A family of lines that differ in where they begin, by a phase in 0..1.
struct Case {
  std::string axis;
  double value;
  std::string variant;
  std::function<Line(double phase)> line;
  double greatest_per_m;                     // extinction
  double before_per_m = 0, after_per_m = 0;  // of a jump; equal: none
  bool even = false;                         // neither extinction nor source varies
};

struct Source {
  const char* name;
  double slope;  // greatest change over the line
  std::function<std::function<double(double)>(double length)> make;
};
const std::array<Source, 3>& sources() {
  static const std::array<Source, 3> all{{
      {"even source", 0, [](double) { return [](double) { return 1.0; }; }},
      {"falling source", 0.9, [](double l) { return [l](double s) { return 1 - 0.9 * s / l; }; }},
      {"rising source", 0.9, [](double l) { return [l](double s) { return 0.1 + 0.9 * s / l; }; }},
  }};
  return all;
}

std::vector<double> decades(double low, double high, int perDecade) {
  std::vector<double> out;
  const int n = int(std::lround(std::log10(high / low) * perDecade));
  for (int i = 0; i <= n; ++i) out.push_back(low * std::pow(10.0, double(i) / perDecade));
  return out;
}

void addStepDepths(std::vector<Case>& cases, int perDecade) {
  for (const double x : decades(1e-6, 1e6, perDecade)) {
    const double sigma = x * kSegments;
    for (const Source& source : sources()) {
      cases.push_back({"optical depth per step", x, std::string("even medium, ") + source.name,
                       [=, &source](double) {
                         return Line{1, [=](double) { return sigma; }, source.make(1), [=](double s) { return sigma * s; }, {}};
                       },
                       sigma, 0, 0, source.slope == 0});
      // 1 +- 0.9 over two periods
      cases.push_back({"optical depth per step", x, std::string("waves, ") + source.name,
                       [=, &source](double p) {
                         const double k = 4 * M_PI, f = 2 * M_PI * p, a = sigma / 1.9;
                         return Line{1,
                                     [=](double s) { return a * (1 + 0.9 * std::sin(k * s + f)); },
                                     source.make(1),
                                     [=](double s) { return a * (s + 0.9 / k * (std::cos(f) - std::cos(k * s + f))); },
                                     {}};
                       },
                       sigma});
    }
  }
}

// One cloud of 2 km, its density a sine squared, from none to a million times that of the Earth's.
void addDensities(std::vector<Case>& cases) {
  std::vector<double> factors = decades(1e-3, 1e6, 1);
  factors.insert(factors.begin(), 0.0);
  for (const double factor : factors) {
    const double sigma = factor * kEarthCloud_per_m, length = 2000;
    for (const Source& source : sources()) {
      cases.push_back({"density, of the Earth's clouds", factor, std::string("cloud, ") + source.name,
                       [=, &source](double p) {
                         const double from = 0.2 * p, w = M_PI / (0.8 * length), begin = from * length, end = begin + 0.8 * length;
                         const auto extinction = [=](double s) {
                           return s > begin && s < end ? sigma * std::pow(std::sin(w * (s - begin)), 2) : 0.0;
                         };
                         const auto depth = [=](double s) {
                           const double t = std::clamp(s - begin, 0.0, 0.8 * length);
                           return sigma * (0.5 * t - std::sin(2 * w * t) / (4 * w));
                         };
                         std::vector<double> breaks;
                         if (begin > 0) breaks.push_back(begin);
                         if (end < length) breaks.push_back(end);
                         return Line{length, extinction, source.make(length), depth, breaks};
                       },
                       sigma});
    }
  }
}

// Extinction that jumps by a million, up or down, somewhere in the middle fifth.
void addEdges(std::vector<Case>& cases, int perDecade) {
  for (const double x : decades(1e-3, 1e6, perDecade)) {
    for (const bool rising : {true, false}) {
      const double thick = x * kSegments, thin = thick * 1e-6, a = rising ? thin : thick, b = rising ? thick : thin;
      for (const Source& source : sources()) {
        cases.push_back({"optical depth per step behind a jump by a million", x,
                         std::string(rising ? "rising, " : "falling, ") + source.name,
                         [=, &source](double p) {
                           const double edge = 0.4 + 0.2 * p;
                           return Line{1,
                                       [=](double s) { return s < edge ? a : b; },
                                       source.make(1),
                                       [=](double s) { return a * std::min(s, edge) + b * std::max(s - edge, 0.0); },
                                       {edge}};
                         },
                         thick, a, b});
      }
    }
  }
}

// Grazing rays through air whose density falls with height, around planets of every size: the altitude along the ray is that of the
// renderer, in single precision and anchored at the entry; the truth's is in double precision.
void addShells(std::vector<Case>& cases) {
  const auto add = [&](const char* axis, double value, double radius, double scale, double depth, double tangent) {
    const double top = 12 * scale, r0 = radius + top, rt = radius + tangent;
    const double half = std::sqrt((top - tangent) * (r0 + rt)), mu = -half / r0;
    const bool ground = tangent < 0;
    const double length = ground ? half - std::sqrt(-tangent * (radius + rt)) : 2 * half;
    const double sigma = depth / std::sqrt(2 * M_PI * radius * scale);
    const auto altitude = [=](double s) {  // (r^2 - R^2) / (r + R), with the tangent point's distance for origin
      const double d = s - half, num = tangent * (radius + rt) + d * d;
      return num / (std::sqrt(radius * radius + num) + radius);
    };
    const float h0 = float(top), m = float(mu), r = float(radius);
    Line line{length,
              [=](double s) { return sigma * std::exp(-double(shared::altitudeAlong(h0, m, float(s), r)) / scale); },
              [=](double s) { return 1 - 0.5 * s / length; },
              {},
              {}};
    Line exact = line;
    exact.extinction_per_m = [=](double s) { return sigma * std::exp(-altitude(s) / scale); };
    const std::string variant =
        std::string(ground ? "tangent 1 mm below the ground" : "tangent 1 mm above the ground") + (depth < 0.1  ? ", thin"
                                                                                                   : depth < 10 ? ", depth 1"
                                                                                                                : ", depth 1000");
    Case c{axis, value, variant, {}, sigma};
    c.line = [line, exact](double p) { return p < 0 ? exact : line; };  // a negative phase asks for the truth's
    cases.push_back(std::move(c));
  };
  for (const double depth : {1e-3, 1.0, 1e3}) {
    for (const double tangent : {1e-3, -1e-3}) {
      for (const double scale : decades(1, 1e5, 1)) add("scale height of the air, m", scale, 6.36e6, scale, depth, tangent);
      for (const double radius : decades(100, 1e8, 1)) add("radius of the planet, m", radius, radius, radius * 1.25e-3, depth, tangent);
    }
  }
}

struct Marched {
  std::uint64_t nan = 0, inf = 0, negative = 0, over = 0;
  double worst = 0;
};
void count(const LineLight& l, Marched& m) {
  m.nan += std::isnan(l.radiance) || std::isnan(l.transmittance);
  m.inf += std::isinf(l.radiance) || std::isinf(l.transmittance);
  m.negative += l.radiance < 0 || l.transmittance < 0;
  m.over += l.radiance > 1 + kFurnaceSlack || l.transmittance > 1 + kFurnaceSlack;
}

StressCell cellOf(const Case& c, Integrator rule) {
  StressCell cell;
  cell.group = "lines", cell.axis = c.axis, cell.value = c.value, cell.variant = c.variant;
  cell.integrator = kIntegratorNames[std::size_t(rule)];
  cell.limit = kStressLimit;
  return cell;
}

// A random line of layers that end where segments do: only the bounds are known of it.
Line randomLine(std::mt19937_64& random) {
  const auto unit = [&] { return double(random() >> 11) * 0x1p-53; };
  const double length = std::pow(10.0, -3 + 10 * unit()), spread = 12 * unit(), middle = -6 + 12 * unit();
  std::array<double, kSegments> x, s;
  for (int i = 0; i < kSegments; ++i) {
    x[std::size_t(i)] = unit() < 0.1 ? 0 : std::pow(10.0, std::clamp(middle + spread * (unit() - 0.5), -6.0, 6.0)) * kSegments / length;
    s[std::size_t(i)] = unit();
  }
  const auto at = [length](const std::array<double, kSegments>& v, double t) {
    return v[std::size_t(std::clamp(int(t / length * kSegments), 0, kSegments - 1))];
  };
  return {length, [=](double t) { return at(x, t); }, [=](double t) { return at(s, t); }, {}, {}};
}

}  // namespace

double predictedExcess(Integrator rule, double x) { return std::abs(double(shared::gainExcess(shared::uint(rule), float(x))) - 1); }

// The jump lies between two nodes, or between a node and a border: of each such pattern the light that the rule adds against the least and
// the most that is right, and what it lets through against the same.
double predictedJump(Integrator rule, double before, double after) {
  const shared::uint id = shared::uint(rule), nodes = shared::integratorNodes(id);
  double worst = 0;
  for (shared::uint k = 0; k <= nodes; ++k) {  // nodes in front of the jump
    shared::vec4 x(0);
    for (shared::uint i = 0; i < 4; ++i) x[int(i)] = float(std::min(i, nodes - 1) < k ? before : after);
    const shared::SegmentGains g = shared::segmentGains(id, x, 1);
    const double sum = g.gain.x + g.gain.y + g.gain.z + g.gain.w;
    const double low = k == 0 ? 0 : shared::integratorNode(id, k - 1), high = k == nodes ? 1 : shared::integratorNode(id, k);
    for (const double at : {low, high}) {
      const double right = -std::expm1(-(before * at + after * (1 - at)));
      worst = std::max(worst, std::abs(sum - right) + std::abs(double(g.transmittance) - (1 - right)));
    }
  }
  return worst;
}

std::vector<StressCell> stressLines(const StressSettings& settings, GainsRule gains) {
  std::vector<Case> cases;
  addStepDepths(cases, settings.quick ? 1 : 3);
  addDensities(cases);
  addEdges(cases, settings.quick ? 1 : 2);
  addShells(cases);
  const int phases = settings.quick ? 3 : 16;
  std::vector<StressCell> cells;
  std::uint64_t rays = 0;
  for (const Case& c : cases) {
    std::vector<Line> lines;
    std::vector<LineLight> truths;
    const bool shells = c.line(-1).depth == nullptr;  // the only lines without a closed form, and without a phase
    for (int i = 0; i < (shells ? 1 : phases); ++i) {
      lines.push_back(c.line((i + 0.5) / phases));
      truths.push_back(exactLine(shells ? c.line(-1) : lines.back()));
    }
    const double step = lines.front().length_m / kSegments;
    double opacity = 0;
    for (const LineLight& t : truths) opacity = std::max(opacity, 1 - t.transmittance);
    for (std::size_t r = 0; r < kIntegratorNames.size(); ++r) {
      const auto rule = Integrator(r);
      StressCell cell = cellOf(c, rule);
      Marched m;
      for (std::size_t i = 0; i < lines.size(); ++i) {
        const LineLight marched = marchLine(lines[i], rule, kSegments, gains);
        count(marched, m);
        m.worst = std::max(m.worst, std::isfinite(marched.radiance) ? relativeError(marched, truths[i]) : HUGE_VAL);
      }
      cell.rays = lines.size(), cell.nan = m.nan, cell.inf = m.inf, cell.negative = m.negative, cell.overFurnace = m.over;
      cell.relativeError = m.worst;
      cell.depthPerStep = c.greatest_per_m * step;
      const bool exponential = rule >= Integrator::ExponentialConstant;
      double excess = predictedExcess(rule, *cell.depthPerStep);
      if (c.before_per_m != c.after_per_m && !exponential && opacity > 0)
        excess += predictedJump(rule, c.before_per_m * step, c.after_per_m * step) / opacity;
      // Of a left sum the error is half a step of the integrand's difference between both ends (Euler and Maclaurin). Of light in an even
      // medium that is the excess; else of each end up to half an optical depth per step remains.
      if (rule == Integrator::Rectangle && !c.even && opacity > 0) excess += 0.5 * *cell.depthPerStep / opacity;
      cell.predictedError = excess;
      cell.predictedFail = cell.predictedError > kStressLimit || opacity * (1 + excess) > 1 + kFurnaceSlack;
      rays += cell.rays;
      cells.push_back(std::move(cell));
    }
  }
  // Bounds over random media: no explicit rule keeps the furnace's.
  std::mt19937_64 random(settings.seed);
  const std::uint64_t left = settings.rays > rays ? settings.rays - rays : 0;
  std::array<Marched, kIntegratorNames.size()> all{};
  const std::uint64_t lines = left / kIntegratorNames.size() + 1;
  for (std::uint64_t i = 0; i < lines; ++i) {
    const Line line = randomLine(random);
    for (std::size_t r = 0; r < kIntegratorNames.size(); ++r) count(marchLine(line, Integrator(r), kSegments, gains), all[r]);
  }
  for (std::size_t r = 0; r < kIntegratorNames.size(); ++r) {
    StressCell cell = cellOf({"random layers", double(lines), "1e-6 to 1e6 a step, random sources", {}, 0}, Integrator(r));
    cell.rays = lines, cell.nan = all[r].nan, cell.inf = all[r].inf, cell.negative = all[r].negative, cell.overFurnace = all[r].over;
    cell.depthPerStep = 1e6;
    cell.predictedError = predictedExcess(Integrator(r), 1e6);
    cell.predictedFail = cell.predictedError > kStressLimit;
    cells.push_back(std::move(cell));
  }
  return cells;
}

}  // namespace welkin::measure
