#pragma once
// Error against run time: what a sweep of settings measured, what follows from it, and the report as JSON and as one page of HTML
// (docs/converge.md).
#include <fmt/format.h>  // before shared headers, whose macro F its templates would meet

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "welkin/measure/image_compare.h"
#include "welkin/measure/statistics.h"
#include "welkin/measure/timings.h"
#include "welkin/physics/scene.h"

namespace welkin::measure {

// How the frames of a setting are made: every pixel marched; one in 16 and a still camera, after 16 frames; the same along a path.
enum class Frames { Full, Still, Moving };
inline constexpr std::array<const char*, 3> kFramesNames{"full", "still", "moving"};

struct ConvergeSetting {
  std::string name;                 // unique in its report
  std::vector<std::string> series;  // lines of the plots that it is a point of
  Quality quality;
  Frames frames = Frames::Full;
  int brickBits = 16;  // of density and light in a brick
  double light = 1;    // fineness of the rays to the sun
};

struct ConvergeRow {
  ConvergeSetting setting;
  Spread time_ms;  // of all passes of a frame
  std::map<std::string, Spread> passes_ms;
  std::uint64_t bytes = 0, samples = 0, cells = 0;  // of the GL; of one picture
  double settle_ms = 0, light_ms = 0;               // to make the tree; of that, its light
  ResidencyStats residency;
  ImageError error;                     // against the truth, over all poses
  std::optional<double> best_rmse_255;  // against the best picture of its own series and trees, in 8 bits, as the thesis does
};

// The slope of log error over log step along a series, by least squares over the points that stand over the truth's own tolerance.
struct ObservedOrder {
  std::string series;
  Integrator integrator{};
  StepRule stepRule{};
  double order = 0;
  int points = 0;
};

struct TruthInfo {
  std::string kind;          // "gpu", "tree", "source"
  std::string description;   // one line
  double tolerance_255 = 0;  // RMSE: how far it may be from what it stands for
};

struct NamedPicture {
  std::string title, caption;
  std::string png;  // bytes of the file
};

// A table of times and errors like the thesis' 6.1: rows are budgets, columns steps.
struct BudgetStepTable {
  std::string title;
  std::vector<std::string> steps, budgets;
  struct Cell {
    double time_ms = 0, rmse_255 = 0;
    std::optional<double> truth_rmse_255;
    std::string residency;
  };
  std::vector<std::vector<Cell>> cells;  // [budget][step]
};

// Names of the rows that no other row beats in time and error at once, fastest first. Of equals the first stands.
std::vector<std::string> paretoFront(const std::vector<ConvergeRow>& rows);

// Slope of log y over log x. None for fewer than two different x or a y that is not positive.
std::optional<double> logSlope(const std::vector<double>& x, const std::vector<double>& y);

// One for each series in which only the step changes. Points nearer to the truth than three times its tolerance say nothing and are left
// out, as are all from the first on that is (coarse steps come first); fewer than three points: no order.
std::vector<ObservedOrder> observedOrders(const std::vector<ConvergeRow>& rows, double truthTolerance_255);

class ConvergeReport {
 public:
  ReportContext context;
  std::string view;
  int poses = 1, repetitions = 0;
  std::string clock;  // what time_ms is read from
  TruthInfo truth;
  std::vector<ConvergeRow> rows;
  std::vector<NamedPicture> pictures;
  std::vector<BudgetStepTable> tables;
  std::vector<std::string> notes;
  double total_s = 0;

  std::string json() const;
  // One file without any link out of it; light and dark.
  std::string html() const;
  std::string table() const;  // for a terminal
};

}  // namespace welkin::measure
