#pragma once
// What `welkin fly` measured, read back from its JSON, and two of them side by side.
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "welkin/core/result.h"

namespace welkin::app {

struct FlightResult {
  std::filesystem::path file;
  std::vector<double> frame_ms;                              // wall time of each frame, in order; at least one
  double median_ms = 0, p95_ms = 0, p99_ms = 0, max_ms = 0;  // of these
  std::vector<std::pair<std::string, double>> passes_ms;     // medians, wall, in the order in which they run
  double wait_ms = 0;                                        // for the worker, all frames together
  double nanPixels = 0, holes = 0, glMessages = 0, greatestBytes = 0;
  std::optional<double> rmse_255;  // median against converged pictures, if that was measured
  bool stopped = false;
  // What the numbers depend on: "size", "scene", "step", "GL", ..., each as one text.
  std::vector<std::pair<std::string, std::string>> settings;
};

// Is the file, by its first key, a result rather than a scene or a path? False if it cannot be read.
bool isFlightResult(const std::filesystem::path& file);
// Errors, one line: not there, no JSON, not written by `welkin fly`, values of a wrong kind, no frames.
Result<FlightResult> loadFlightResult(const std::filesystem::path& file);
Result<FlightResult> parseFlightResult(std::string_view text, const std::string& sourceName);

struct ComparedRow {
  std::string name;
  std::optional<double> a, b;   // absent: this one has no such pass
  std::optional<double> ratio;  // b / a, of times
  const char* unit = "";
  bool counted = false;  // a whole number
};
struct DifferentSetting {
  std::string name, a, b;  // "-": it is not said
};
struct ResultComparison {
  std::vector<ComparedRow> rows;  // whole frames, passes in the order of a, then what only b has, counts
  std::vector<DifferentSetting> different;
};
ResultComparison compareResults(const FlightResult& a, const FlightResult& b);
std::string comparisonText(const ResultComparison& comparison);  // a table, and below it what differs; no path in it
std::string comparisonJson(const FlightResult& a, const FlightResult& b);

std::string valueText(const ComparedRow& row, const std::optional<double>& value);  // four digits, or a whole number; "-" for none
std::string ratioText(const ComparedRow& row);

}  // namespace welkin::app
