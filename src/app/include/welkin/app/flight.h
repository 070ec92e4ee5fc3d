#pragma once
// Replays a recorded path, measures every frame, and leaves timings.json, pictures, a contact sheet and perhaps a video.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "welkin/app/options.h"
#include "welkin/core/result.h"
#include "welkin/physics/path_io.h"

namespace welkin::app {

struct FlightOptions {
  CommonOptions common;
  std::filesystem::path path;
  FrameRange range;
  std::filesystem::path out;    // empty: out/NAME of the path
  std::filesystem::path video;  // empty: none
  std::optional<int> every;     // frames between pictures; 0: none; absent: about a dozen pictures
  std::vector<int> qualityFrames;
  std::optional<FrameRange> pop;        // frames whose change by the tree alone is measured (two more full marches each)
  std::uint32_t bricksPerFrame = 2048;  // a descent of 4 % of the altitude a frame renews what is seen every 25 frames
  std::uint32_t workerJitter = 0;
  bool waitForEdits = true;
  DebugView debug = DebugView::None;
  std::string command;  // as typed, for the report
};

// What is decided before any GL is opened, so that wrong input and unwritable folders show at once.
struct FlightPlan {
  FlightPath path;
  Scene scene;
  Size size;
  int first = 0, end = 0;  // frames, end not included
  int every = 0;
  std::filesystem::path out, json;
  double framesPerSecond = 30;
};
Result<FlightPlan> planFlight(const FlightOptions& options);
bool pictureWanted(const FlightPlan& plan, int frame);      // every so many, and the last one
std::string pictureName(int frame);                         // "frame-00120.png"
double altitude_m(const View& view, const Planet& planet);  // above the ground

// Who looks on while a flight is replayed.
struct FlightWatch {
  std::function<bool(double fraction, const std::string& note)> progress;  // false: stop after this frame
  std::function<void(int frame, const Image8& picture)> picture;           // every frame as it is drawn; empty: nobody asks for them
};
// Draws the frames and writes what the plan says, but for the JSON. Ended early: the report's `stopped`.
Result<measure::TimingReport> replay(const FlightOptions& options, FlightPlan plan, const FlightWatch& watch);

// Runs it. Prints the table on stdout. Error: the first thing that went wrong; files written before it are whole.
Result<void> fly(const FlightOptions& options);

}  // namespace welkin::app
