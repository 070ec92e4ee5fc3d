#include "welkin/measure/converge.h"

#include <algorithm>
#include <cmath>

#include "welkin/core/units.h"

namespace welkin::measure {
namespace {

constexpr double kOverTolerance = 3;  // an error of so many tolerances is known to a third
constexpr int kLeastPoints = 3;       // two points always lie on a line

}  // namespace

std::vector<std::string> paretoFront(const std::vector<ConvergeRow>& rows) {
  std::vector<const ConvergeRow*> order;
  for (const auto& row : rows) order.push_back(&row);
  std::stable_sort(order.begin(), order.end(), [](const ConvergeRow* a, const ConvergeRow* b) {
    return a->time_ms.median != b->time_ms.median ? a->time_ms.median < b->time_ms.median : a->error.rmse_255 < b->error.rmse_255;
  });
  std::vector<std::string> front;
  double least = std::numeric_limits<double>::infinity();
  for (const auto* row : order) {
    if (!(row->error.rmse_255 < least)) continue;  // NaN never gets in
    least = row->error.rmse_255;
    front.push_back(row->setting.name);
  }
  return front;
}

std::optional<double> logSlope(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
    if (!(x[i] > 0) || !(y[i] > 0)) return std::nullopt;
    const double lx = std::log(x[i]), ly = std::log(y[i]);
    n += 1, sx += lx, sy += ly, sxx += lx * lx, sxy += lx * ly;
  }
  const double spread = n * sxx - sx * sx;
  if (n < 2 || spread <= 1e-9 * n * sxx) return std::nullopt;
  return (n * sxy - sx * sy) / spread;
}

std::vector<ObservedOrder> observedOrders(const std::vector<ConvergeRow>& rows, double truthTolerance_255) {
  std::vector<std::string> names;
  for (const auto& row : rows)
    for (const auto& series : row.setting.series)
      if (std::find(names.begin(), names.end(), series) == names.end()) names.push_back(series);
  std::vector<ObservedOrder> out;
  for (const auto& name : names) {
    std::vector<const ConvergeRow*> points;
    for (const auto& row : rows)
      if (std::find(row.setting.series.begin(), row.setting.series.end(), name) != row.setting.series.end()) points.push_back(&row);
    const auto sameButStep = [&](const ConvergeRow* row) {
      const Quality &a = row->setting.quality, &b = points.front()->setting.quality;
      return a.integrator == b.integrator && a.stepRule == b.stepRule && a.budget_bytes == b.budget_bytes && a.depth == b.depth &&
             a.detail == b.detail && a.skipEmpty == b.skipEmpty && a.spread == b.spread && row->setting.frames == Frames::Full;
    };
    if (!std::all_of(points.begin(), points.end(), sameButStep)) continue;
    std::stable_sort(points.begin(), points.end(),
                     [](const auto* a, const auto* b) { return a->setting.quality.step > b->setting.quality.step; });
    std::vector<double> steps, errors;
    for (const auto* row : points) {
      if (!(row->error.rmse_255 > kOverTolerance * truthTolerance_255)) break;
      steps.push_back(row->setting.quality.step);
      errors.push_back(row->error.rmse_255);
    }
    if (int(steps.size()) < kLeastPoints) continue;
    const auto slope = logSlope(steps, errors);
    const Quality& q = points.front()->setting.quality;
    if (slope) out.push_back({name, q.integrator, q.stepRule, *slope, int(steps.size())});
  }
  return out;
}

std::string ConvergeReport::table() const {
  std::size_t width = 7;
  for (const auto& row : rows) width = std::max(width, row.setting.name.size());
  const auto front = paretoFront(rows);
  std::string out = fmt::format("{:<{}}  {:>9} {:>13}  {:>8} {:>8} {:>6} {:>6} {:>7} {:>7}  {:>9}\n", "setting", width, "ms", "p25..p75",
                                "RMSE", "relative", "p99", "max", "> 2", "flip", "bytes");
  for (const auto& row : rows) {
    const bool best = std::find(front.begin(), front.end(), row.setting.name) != front.end();
    out +=
        fmt::format("{:<{}}  {:>9.2f} {:>13}  {:>8.4f} {:>8.5f} {:>6.2f} {:>6.1f} {:>6.2f}% {:>7}  {:>9}{}\n", row.setting.name, width,
                    row.time_ms.median, fmt::format("{:.2f}..{:.2f}", row.time_ms.p25, row.time_ms.p75), row.error.rmse_255,
                    row.error.relativeRmse, row.error.p99_255, row.error.max_255, 100 * row.error.shareOver2,
                    std::isfinite(row.error.flip) ? fmt::format("{:.5f}", row.error.flip) : "-", bytesText(row.bytes), best ? "  *" : "");
  }
  out += fmt::format("* no other setting is faster and nearer. RMSE, p99, max on 0-255; truth: {} ({:.4f} RMSE).\n", truth.description,
                     truth.tolerance_255);
  for (const auto& order : observedOrders(rows, truth.tolerance_255))
    out += fmt::format("observed order {:>5.2f} ({} points): {}\n", order.order, order.points, order.series);
  for (const auto& t : tables) {
    out += fmt::format("{}\n{:<26}", t.title, "");
    for (const auto& step : t.steps) out += fmt::format("{:>25}", step);
    for (std::size_t b = 0; b < t.cells.size(); ++b) {
      out += fmt::format("\n{:<26}", t.budgets[b]);
      for (const auto& cell : t.cells[b])
        out += fmt::format("{:>25}", cell.truth_rmse_255
                                         ? fmt::format("{:.1f} ms / {:.2f} ({:.2f})", cell.time_ms, cell.rmse_255, *cell.truth_rmse_255)
                                         : fmt::format("{:.1f} ms / {:.2f}", cell.time_ms, cell.rmse_255));
      if (!t.cells[b].empty() && !t.cells[b].front().residency.empty()) out += "  " + t.cells[b].front().residency;
    }
    out += "\n";
  }
  return out;
}

}  // namespace welkin::measure
