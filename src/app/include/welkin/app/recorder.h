#pragma once
// A flight as it happens, frame by frame, made into a path that `welkin fly` replays.
#include <filesystem>
#include <vector>

#include "welkin/core/result.h"
#include "welkin/physics/path_io.h"

namespace welkin::app {

struct LiveFrame {
  double at_s;  // since the recording began
  View view;
  double time_s;  // scene time
};

class Recording {
 public:
  // Frames come in the order of time: one at or before the last replaces it. False, and it is not kept: not of finite numbers, or more than
  // kMaxPathFrames.
  bool add(double at_s, const View& view, double time_s);

  bool empty() const { return frames_.empty(); }
  const std::vector<LiveFrame>& frames() const { return frames_; }
  double duration_s() const { return frames_.empty() ? 0 : frames_.back().at_s - frames_.front().at_s; }

  // The frame at a time from the first one, between two frames if need be. Not of an empty recording.
  LiveFrame at(double time_s) const;
  // A frame every timeStep_s. The path's scene, size and name are the caller's to fill in.
  // Errors: nothing recorded, more than kMaxPathFrames.
  Result<FlightPath> path(double timeStep_s) const;

 private:
  std::vector<LiveFrame> frames_;
};

// Between two views, 0..1: direction from the planet's centre along the great circle, distance in proportion, so never below the lower one;
// orientation by slerp in axes that the way carries along. 0 and 1 give the views to the bit.
View viewBetween(const View& a, const View& b, double part);

// Writes FOLDER/STEM.json, or STEM-2.json, … if that is taken, and gives its name. The path refers to scene.file, unless the scene was
// changed since it was loaded (or came out of a picture): then to a copy, STEM.scene.json.
Result<std::filesystem::path> saveRecorded(FlightPath path, const Scene& scene, bool sceneChanged, const std::filesystem::path& folder,
                                           const std::string& stem);

}  // namespace welkin::app
