#pragma once
// One ray through a medium that is known everywhere: marched with the very code of the renderer's march, and the truth beside it.
#include <functional>
#include <vector>

#include "welkin/physics/scene.h"
#include "welkin/shared/integrators.glsl.h"

namespace welkin::measure {

struct Line {
  double length_m = 1;                             // the march ends exactly here
  std::function<double(double)> extinction_per_m;  // at a distance from the eye [m]; not negative
  std::function<double(double)> source;  // what an opaque medium would show there; 0..1, so that no ray shows more than 1 (furnace)
  std::function<double(double)> depth;   // integral of the extinction up to a distance; absent: by quadrature
  std::vector<double> breaks_m;          // ascending, inside the line: where extinction or source is not smooth
};

struct LineLight {
  double radiance = 0, transmittance = 1;
  int segments = 0;
};

// What a segment sends and lets through: shared::segmentGains, or in a test one that is wrong.
using GainsRule = shared::SegmentGains (*)(shared::uint rule, shared::vec4 extinction_per_m, float length_m);

// In `segments` equal parts, in single precision as on the GPU. kExponentialLinear takes the first midpoint for the one before it.
LineLight marchLine(const Line& line, Integrator rule, int segments, GainsRule gains = shared::segmentGains);

// With Integrator::Adaptive in segments that it chooses itself: of each, light and opacity differ from the coarse estimate by at most the
// tolerance (of a source of 1) times the mean of its share of the length and of the opacity, or by rounding.
LineLight marchLineAdaptive(const Line& line, double tolerance, GainsRule gains = shared::segmentGains);

// Double precision, adaptive, to 1e-10 relative (radiance) or 1e-14.
LineLight exactLine(const Line& line);

// |marched - exact| over the most that the line's opacity could show.
double relativeError(const LineLight& marched, const LineLight& exact);

// Observed order of convergence: slope of log error over log step, least squares, over steps from a half to 1/4096 of the line where
// truncation rules: errors below 1 % (not yet asymptotic above) and over 20 roundings of single precision (6e-8) or one every second
// segment, for sums of equal terms round to one side. The error is the root mean square over a family of lines: of one alone it may change
// its sign between two steps.
struct Order {
  double slope = 0;
  int counts = 0;              // step sizes fitted; below 3 the slope says nothing
  double greatestError = 0;    // over all step sizes
  double greatestPerStep = 0;  // of error over step / length
};
Order observedOrder(const std::vector<Line>& family, Integrator rule, GainsRule gains = shared::segmentGains);

// The lines on which orders are promised. `stiff`: optically thick in a step (but for one, thin everywhere): only the exponential rules are
// asked.
struct OrderLines {
  const char* name;
  bool stiff;
  std::vector<Line> family;
};
std::vector<OrderLines> orderLines();
double promisedOrder(Integrator rule, bool stiff);  // 0: none
constexpr double kOrderSlack = 0.15;                // a fitted slope of few points; the next order's term bends it

struct OrderCheck {
  const char* line;
  Integrator rule;
  double promised;
  Order observed;
  bool ok;
};
std::vector<OrderCheck> checkOrders(GainsRule gains = shared::segmentGains);

}  // namespace welkin::measure
