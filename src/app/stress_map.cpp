#include "welkin/app/stress_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "welkin/app/contact_sheet.h"

namespace welkin::app {
namespace {

constexpr int kLeft = 620, kCell = 22, kRow = 26, kTop = 44, kLetter = 14;
constexpr double kLeast = 1e-7, kMost = 10;  // errors at the ends of the colours

using Colour = std::array<std::uint8_t, 3>;

// From deep blue over green and yellow to red, evenly in the logarithm.
Colour colourOf(double error) {
  static constexpr std::array<std::array<double, 3>, 5> ramp{{{24, 40, 110}, {30, 120, 150}, {70, 170, 90}, {235, 200, 60}, {200, 40, 30}}};
  const double t = std::clamp(std::log(std::max(error, kLeast) / kLeast) / std::log(kMost / kLeast), 0.0, 1.0) * (ramp.size() - 1);
  const auto i = std::min(std::size_t(t), ramp.size() - 2);
  Colour out;
  for (std::size_t c = 0; c < 3; ++c) out[c] = std::uint8_t(std::lround(ramp[i][c] + (t - double(i)) * (ramp[i + 1][c] - ramp[i][c])));
  return out;
}

struct Worst {
  double error = 0;
  bool known = false, fails = false;
  void add(const measure::StressCell& c) {
    if (c.relativeError) error = std::max(error, *c.relativeError), known = true;
    fails |= !c.ok();
  }
};

void set(Image8& image, int x, int y, Colour colour) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  std::copy(colour.begin(), colour.end(), image.rgba.begin() + (std::ptrdiff_t(y) * image.width + x) * 4);
}

void drawCell(Image8& image, int x0, int y0, const Worst& w) {
  const Colour colour = w.known ? colourOf(w.error) : Colour{90, 90, 90};
  for (int y = 0; y < kCell - 2; ++y) {
    for (int x = 0; x < kCell - 2; ++x) {
      const bool cross =
          w.fails && (std::abs(x - y) < 2 || std::abs(x + y - kCell + 3) < 2) && x > 3 && y > 3 && x < kCell - 6 && y < kCell - 6;
      set(image, x0 + x, y0 + y, cross ? Colour{255, 255, 255} : colour);
    }
  }
}

}  // namespace

Image8 stressMap(const measure::StressReport& report) {
  const std::string stepAxis = "optical depth per step";
  std::map<std::string, std::map<double, Worst>> rules, axes;
  for (const auto& c : report.cells) {
    if (c.axis == stepAxis) rules[c.integrator][c.value].add(c);
    if (c.integrator == report.defaultIntegrator) axes[(c.group == "lines" ? "line: " : "picture: ") + c.axis][c.value].add(c);
  }
  std::size_t columns = 0;
  for (const auto& [name, row] : rules) columns = std::max(columns, row.size());
  for (const auto& [name, row] : axes) columns = std::max(columns, row.size());
  Image8 image{kLeft + int(columns) * kCell + 20, kTop + int(kIntegratorNames.size() + axes.size()) * kRow + 130, {}};
  image.rgba.assign(std::size_t(image.width) * std::size_t(image.height) * 4, 24);
  int y = kTop;
  const auto drawRow = [&](const std::string& name, const std::map<double, Worst>& row) {
    writeText(image, name, 12, y + (kCell - kLetter) / 2, kLeft - 8);
    int x = kLeft;
    for (const auto& [value, worst] : row) drawCell(image, x, y, worst), x += kCell;
    y += kRow;
  };
  writeText(image, "integrator by optical depth per step, 1e-6 to 1e6", 12, 14, image.width);
  for (const char* name : kIntegratorNames) drawRow(name, rules[name]);
  y += 44;
  writeText(image, "default: " + report.defaultIntegrator + ", other axes, ascending", 12, y - 24, image.width);
  for (const auto& [name, row] : axes) drawRow(name, row);
  y += 22;
  writeText(image, "error 1e-7", 12, y, image.width);
  for (int i = 0; i < 300; ++i)
    for (int j = 0; j < kLetter; ++j) set(image, 170 + i, y + j, colourOf(kLeast * std::pow(kMost / kLeast, i / 299.0)));
  writeText(image, "10   cross: fails   grey: bounds only", 482, y, image.width);
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = 255;
  return image;
}

}  // namespace welkin::app
