#pragma once
// Error against run time over a sweep of settings, from one view or along a path (docs/converge.md).
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "welkin/app/options.h"
#include "welkin/core/result.h"
#include "welkin/measure/converge.h"

namespace welkin::app {

// The renderer's own march in very fine steps; the resident tree, or the cloud source without voxels, in double precision on the CPU.
enum class TruthKind { Gpu, Tree, Source };
inline constexpr std::array<const char*, 3> kTruthNames{"gpu", "tree", "source"};

struct SweepAxis {
  std::string name;
  std::vector<std::string> values;
};
inline constexpr std::array<const char*, 11> kSweepAxes{"step",   "integrator", "step-rule", "spread",     "budget", "depth",
                                                        "detail", "frames",     "brick-bits", "light",      "skip-empty"};
Result<SweepAxis> parseSweep(const std::string& text);  // "step=0.1,0.2"; every value is read, so that wrong ones show at once

// Every combination of the axes' values, the first axis slowest; what no axis names is the base's. Settings of one series differ in the
// step alone if that is swept, else in the last axis. Names say what differs from the base.
std::vector<measure::ConvergeSetting> combine(const measure::ConvergeSetting& base, const std::vector<SweepAxis>& axes);
// Adds settings; one that is there already only joins the series.
void merge(std::vector<measure::ConvergeSetting>& settings, const std::vector<measure::ConvergeSetting>& more);

inline constexpr std::array<const char*, 8> kPresetNames{"default", "quick", "rules", "detail", "frames", "bricks", "light", "thesis"};
// Settings of a preset but "thesis", which has to look for its budget first.
std::vector<measure::ConvergeSetting> presetSettings(const std::string& preset, const measure::ConvergeSetting& base);

// The thesis' Table 6.1: its steps and budgets with its way to integrate, and with ours.
constexpr int kThesisDepth = 13;
struct ThesisBudget {  // its budgets are those of the tree alone; ours cover tables, maps and the rest too, which no part of the tree
                       // changes
  std::uint64_t rest_bytes = 0, tree_bytes = 0;
  std::uint64_t of(std::uint64_t parts) const { return ((rest_bytes + tree_bytes / parts + (1 << 20) - 1) >> 20) << 20; }  // whole MiB
};
std::vector<measure::ConvergeSetting> thesisSettings(const measure::ConvergeSetting& base, const ThesisBudget& budget);
std::vector<measure::BudgetStepTable> thesisTables(const std::vector<measure::ConvergeRow>& rows);

struct ConvergeOptions {
  CommonOptions common;
  std::filesystem::path input;  // a scene, a picture, or a path
  std::string view;
  std::filesystem::path html;
  std::string preset = "default";
  std::vector<SweepAxis> sweep;  // in place of the preset's
  TruthKind truth = TruthKind::Gpu;
  std::optional<int> truthEvery;   // tree, source: one pixel in so many squared; absent: all of a tree's, one in 64 of a source's
  int repetitions = 7, poses = 5;  // poses: of a path, evenly along it
  std::string command;
};

// Measures, prints the table, writes JSON and HTML. Error: the first thing that went wrong; nothing is written then.
Result<void> converge(const ConvergeOptions& options);

}  // namespace welkin::app
