#include "log_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace welkin::measure {
namespace {

constexpr double kWidth = 720, kHeight = 420, kLeft = 74, kRight = 16, kTop = 14, kBottom = 56;

struct Axis {
  double low, high;  // decimal logarithms
  double from, to;   // pixels
  double at(double v) const { return from + (std::log10(v) - low) / (high - low) * (to - from); }
};

// Room for all values, at least a third of a decade.
Axis fit(double least, double greatest, double from, double to) {
  double low = std::log10(least), high = std::log10(greatest);
  const double margin = std::max(0.05 * (high - low), (0.35 - (high - low)) / 2);
  return {low - margin, high + margin, from, to};
}

// 1, 2, 5 of each decade, or decades alone where there are many, or finer where there is less than one.
std::vector<double> ticks(const Axis& axis) {
  const double decades = axis.high - axis.low;
  std::vector<double> steps{1, 2, 5};
  if (decades > 3.2) steps = {1};
  if (decades < 1.7) steps = {1, 2, 3, 5, 7};
  if (decades < 0.9) steps = {1, 1.5, 2, 3, 4, 5, 6, 7, 8, 9};
  std::vector<double> out;
  for (int d = int(std::floor(axis.low)); d <= int(std::ceil(axis.high)); ++d)
    for (const double s : steps) {
      const double v = s * std::pow(10.0, d), l = std::log10(v);
      if (l >= axis.low && l <= axis.high) out.push_back(v);
    }
  return out;
}

}  // namespace

std::string htmlText(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string svg(const LogPlot& plot) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  double x0 = inf, x1 = 0, y0 = inf, y1 = 0;
  const auto shown = [](const PlotPoint& p) { return p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y); };
  for (const auto& line : plot.lines)
    for (const auto& p : line.points)
      if (shown(p)) x0 = std::min(x0, p.x), x1 = std::max(x1, p.x), y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
  if (x1 <= 0) return "<p>Nothing to plot: no setting differs from the truth.</p>";
  const Axis x = fit(x0, x1, kLeft, kWidth - kRight), y = fit(y0, y1, kHeight - kBottom, kTop);
  const double bottom = kHeight - kBottom, right = kWidth - kRight;
  std::string out =
      fmt::format("<svg class=\"plot\" viewBox=\"0 0 {:g} {:g}\" role=\"img\" aria-label=\"{}\">\n", kWidth, kHeight, htmlText(plot.label));
  if (plot.floor > 0 && std::log10(plot.floor) > y.low) {
    const double top = std::clamp(y.at(plot.floor), kTop, bottom);
    out += fmt::format(
        "<rect class=\"floor\" x=\"{:g}\" y=\"{:.1f}\" width=\"{:g}\" height=\"{:.1f}\"/><text class=\"faint\" x=\"{:g}\" "
        "y=\"{:.1f}\" text-anchor=\"end\">below the truth's own tolerance</text>\n",
        kLeft, top, right - kLeft, bottom - top, right - 6, std::min(top + 16, bottom - 5));
  }
  for (const double v : ticks(x))
    out += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:g}\" y2=\"{2:g}\"/><text x=\"{0:.1f}\" y=\"{3:g}\" "
        "text-anchor=\"middle\">{4:.3g}</text>\n",
        x.at(v), kTop, bottom, bottom + 20, v);
  for (const double v : ticks(y))
    out += fmt::format(
        "<line class=\"grid\" x1=\"{0:g}\" x2=\"{1:g}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/><text x=\"{3:g}\" y=\"{4:.1f}\" "
        "text-anchor=\"end\">{5:.3g}</text>\n",
        kLeft, right, y.at(v), kLeft - 8, y.at(v) + 5, v);
  out += fmt::format("<text class=\"title\" x=\"{:.1f}\" y=\"{:g}\" text-anchor=\"middle\">{}</text>\n", (kLeft + right) / 2, kHeight - 12,
                     htmlText(plot.xTitle));
  out += fmt::format("<text class=\"title\" transform=\"translate(18 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                     (kTop + bottom) / 2, htmlText(plot.yTitle));
  for (const int n : plot.slopes) {  // from the middle of the top, clipped to the frame
    const double xs = std::sqrt(x0 * x1), ys = y1;
    const double reach = std::min(std::log10(ys) - y.low, n * (std::log10(xs) - x.low)) / n;  // decades to the left
    const double xe = xs * std::pow(10.0, -reach), ye = ys * std::pow(10.0, -reach * n);
    out += fmt::format(
        "<line class=\"guide\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/><text class=\"faint\" x=\"{:.1f}\" "
        "y=\"{:.1f}\" text-anchor=\"middle\">order {}</text>\n",
        x.at(xs), y.at(ys), x.at(xe), y.at(ye), std::max(x.at(xe), kLeft + 26), std::min(y.at(ye) + 14, bottom - 5), n);
  }
  std::string front;
  for (const auto& p : plot.front)
    if (shown(p)) front += fmt::format("{:.1f},{:.1f} ", x.at(p.x), y.at(p.y));
  if (!front.empty()) out += fmt::format("<polyline class=\"front\" points=\"{}\"/>\n", front);
  for (const auto& line : plot.lines) {
    std::string points, dots;
    for (const auto& p : line.points) {
      if (!shown(p)) continue;
      const double px = x.at(p.x), py = y.at(p.y);
      points += fmt::format("{:.1f},{:.1f} ", px, py);
      if (p.ringed) dots += fmt::format("<circle class=\"ring\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"9\"/>", px, py);
      dots += fmt::format(
          "<circle class=\"dot\" tabindex=\"0\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4.5\" data-name=\"{}\"><title>{}</title></circle>\n", px,
          py, htmlText(p.name), htmlText(p.name));
    }
    if (dots.empty()) continue;
    out += fmt::format("<g class=\"c{}\"><polyline class=\"line{}\" points=\"{}\"/>{}</g>\n", line.colour, line.dashed ? " dashed" : "",
                       points, dots);
  }
  return out + "</svg>\n";
}

}  // namespace welkin::measure
