#pragma once
// How well `--tolerance` picks: against every candidate that there is, over the views of a scene (docs/tolerance.md).
#include <filesystem>
#include <vector>

#include "welkin/app/options.h"

namespace welkin::app {

struct ToleranceSweepOptions {
  CommonOptions common;
  std::filesystem::path input;    // a scene
  std::string view;               // empty: all
  std::vector<double> asked_255;  // RMSE on 0..255
  int repetitions = 3;            // timed frames of each candidate
};
Result<void> toleranceSweep(const ToleranceSweepOptions& options);
Result<std::vector<double>> parseTolerances(const std::string& text);  // "0.5,1,2"

}  // namespace welkin::app
