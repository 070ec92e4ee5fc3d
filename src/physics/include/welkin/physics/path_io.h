#pragma once
// Recorded flights: one pose a frame at a fixed time step.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "welkin/core/result.h"
#include "welkin/physics/scene.h"

namespace welkin {

struct PathFrame {
  View view;
  double time_s = 0;  // scene time
};

struct FlightPath {
  std::string name;
  std::filesystem::path file;   // where it came from
  std::filesystem::path scene;  // absolute, or as given if there is no file
  int width = 1280, height = 720;
  double timeStep_s = 1.0 / 30;
  int warmUp = 0;  // frames drawn at the first pose before the first frame counts
  std::vector<PathFrame> frames;
};

constexpr int kMaxPictureEdge = 16384;  // pixels; the portable limit of 2-D textures
constexpr int kMaxPathFrames = 1000000;

// Positions are not held against the ground here: checkPath does that once the scene is known.
Result<FlightPath> loadPath(const std::filesystem::path& file);
Result<FlightPath> parsePath(std::string_view text, const std::string& sourceName, const std::filesystem::path& baseFolder = {});
std::string pathToJson(const FlightPath& path, const std::filesystem::path& baseFolder = {});
Result<void> savePath(const FlightPath& path, const std::filesystem::path& file);
// Every position on or above the ground of `planet`.
Result<void> checkPath(const FlightPath& path, const Planet& planet);

}  // namespace welkin
