#pragma once
// The stability matrix: what the renderer's march and the renderer itself do where things are extreme (docs/stress.md).
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "welkin/measure/line_march.h"

namespace welkin::measure {

struct StressCell {
  std::string group;    // "lines" or "pictures"
  std::string axis;     // what is varied
  double value = 0;     // to this
  std::string variant;  // the medium, the view
  std::string integrator;
  std::uint64_t rays = 0, nan = 0, inf = 0, negative = 0, overFurnace = 0;
  std::optional<double> relativeError;  // greatest of the rays with a truth, over the most that each could show
  double limit = 0;                     // of that error
  std::optional<double> depthPerStep;   // greatest optical depth of a segment
  double predictedError = 0;            // from step times extinction alone
  bool predictedFail = false;
  std::string note;  // what kept the cell from being measured; it then fails

  bool ok() const;
};

struct StressSettings {
  bool quick = false;
  std::uint64_t rays = 1'000'000;  // at least
  std::uint64_t seed = 1;
};

using StressProgress = std::function<bool(double fraction)>;  // false: stop

// Error of the light, over the most that the line could show, that counts as failing: what is seen at a glance.
constexpr double kStressLimit = 0.05;

// Every integrator on lines whose truth is known, by optical depth per step, density, edges, shells, sources; then random lines, of which
// only the bounds are known, until `rays` are reached.
std::vector<StressCell> stressLines(const StressSettings& settings, GainsRule gains = shared::segmentGains);

// What a rule adds too much of the light in segments of optical depth up to x, as a share; and with a jump from extinction `before` to
// `after` (times the step) somewhere inside a segment.
double predictedExcess(Integrator rule, double x);
double predictedJump(Integrator rule, double before, double after);

struct StressReport {
  std::string defaultIntegrator;
  std::vector<StressCell> cells;
  std::vector<OrderCheck> orders;
  double seconds = 0;

  std::uint64_t rays(const std::string& group = "") const;
  std::size_t failing() const;
  std::size_t mispredicted() const;  // failing cells that were not predicted
  std::size_t pessimistic() const;   // predicted ones that did not fail
  std::size_t failingOfDefault() const;
  bool ok() const;  // nothing mispredicted, the default fails nowhere, orders as promised
  std::string json() const;
};

}  // namespace welkin::measure
