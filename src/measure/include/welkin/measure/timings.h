#pragma once
// The report of a flight or of one picture: times by pass, residency, counters, errors, as JSON and as a table (docs/files.md).
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "welkin/measure/image_compare.h"
#include "welkin/measure/tolerance.h"
#include "welkin/measure/statistics.h"
#include "welkin/render/renderer.h"

namespace welkin::measure {

// Who measured, with what. Lines that stay empty are left out of the JSON.
struct ReportContext {
  std::string date, build, commit, glRenderer, glVersion, glVendor, cpu, command;
  bool software = false;
  int cpus = 0;
  std::string scene, path;
  std::map<std::string, std::string> data;  // file -> sha256, or "missing"
  // Settings that the numbers depend on.
  int width = 0, height = 0, depth = 0;
  double step = 0, detail = 0, spread = 0;
  std::string integrator, stepRule;  // by name
  bool skipEmpty = true;
  std::uint32_t seed = 0, bricksPerFrame = 0;
  std::uint64_t budget_bytes = 0;
  bool deterministic = true;
};

struct FrameRow {
  int pathFrame = 0;
  double time_s = 0, altitude_m = 0;
  FrameStats stats;
  std::string picture;  // file name, if one was written
};

struct QualityRow {
  int pathFrame = 0;
  ImageError error;
};

// Change of the picture between the trees of two consecutive frames, seen from one pose, fully marched, at one exposure.
struct PopRow {
  int pathFrame = 0;
  double p999_255 = 0, mean_255 = 0, max_255 = 0;
};

struct PassRow {
  std::string name;
  Summary wall_ms, cpu_ms;
  double share = 0;  // of the sum of all passes' wall times
};

// A march that was picked for a tolerance (measure/tolerance.h).
struct ToleranceRow {
  int pathFrame = 0;
  MarchChoice choice;
  std::optional<double> reached_255;  // over the whole picture, where that was measured
};

class TimingReport {
 public:
  ReportContext context;
  std::string name = "fly";  // first part of the benchmark names
  std::vector<FrameRow> frames;
  std::vector<QualityRow> quality;
  std::vector<PopRow> pops;
  std::optional<double> tolerance_255;  // asked for
  std::vector<ToleranceRow> tolerance;  // newest last
  std::optional<DebugNumbers> debug;    // of the last picture, if that is a debug view
  std::optional<double> time_ms;        // of one picture with every pixel marched: median of repeated frames, wall
  std::vector<LeftOut> leftOut;
  std::vector<std::string> passOrder;  // passes are listed in this order, unknown ones after them
  std::map<std::string, std::uint64_t> memoryByName;
  std::vector<std::string> notes;
  std::uint64_t glMessages = 0;
  std::vector<std::string> glFirstMessages;
  double total_s = 0;
  bool stopped = false;  // ended early by the user

  std::vector<PassRow> passes() const;
  std::string json() const;
  // Lines "pass  median  p95  share", with the whole frame last.
  std::string table() const;
  std::uint64_t nanPixels() const;
  std::uint64_t holes() const;
  std::uint64_t greatestBytes() const;
};

}  // namespace welkin::measure
