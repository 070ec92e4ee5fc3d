#pragma once
// A log-log plot as inline SVG: colours come from the page's style (classes c0, c1, ...), so it follows light and dark.
#include <string>
#include <vector>

namespace welkin::measure {

struct PlotPoint {
  double x = 0, y = 0;
  std::string name;  // what is shown when it is pointed at
  bool ringed = false;
};
struct PlotLine {
  int colour = 0;
  bool dashed = false;
  std::vector<PlotPoint> points;  // joined in this order
};
struct LogPlot {
  std::string xTitle, yTitle, label;  // label: for those who cannot see it
  std::vector<PlotLine> lines;
  std::vector<PlotPoint> front;  // a thick line below the others
  double floor = 0;              // errors below it say nothing: shaded
  std::vector<int> slopes;       // guides y ~ x^n through the upper right
};

std::string svg(const LogPlot& plot);  // points that are not positive are left out
std::string htmlText(const std::string& text);

}  // namespace welkin::measure
