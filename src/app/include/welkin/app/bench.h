#pragma once
// One pose of a scene, measured: how long a cold start takes, what a frame costs, how far the picture is from a finely marched one.
#include <filesystem>
#include <string>

#include "welkin/app/options.h"
#include "welkin/core/result.h"

namespace welkin::app {

struct BenchOptions {
  CommonOptions common;
  std::filesystem::path scene;
  std::string view;
  int frames = 30;        // of each kind, the medians are over these
  bool coldStart = true;  // a second renderer from an empty tree, after the first one is gone
};

// Prints a table on stdout; with --json writes the same (docs/files.md). Error: the first thing that went wrong.
Result<void> bench(const BenchOptions& options);

}  // namespace welkin::app
