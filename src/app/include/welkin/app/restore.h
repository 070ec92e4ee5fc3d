#pragma once
// What a file dropped onto the window brings back.
#include "welkin/app/flight_result.h"
#include "welkin/app/options.h"
#include "welkin/physics/path_io.h"

namespace welkin::app {

enum class RestoredKind { Scene, Picture, Path, FlightResult };

struct Restored {
  RestoredKind kind;
  Start start;                         // scene, view, size, time; of a path its first frame
  std::optional<FlightPath> path;      // of a path
  std::optional<FlightResult> result;  // of a result, which has nothing else
};
// By the file's first bytes, not its name. Errors, one line each: not there, a folder or no plain file, unreadable, too large, broken, a
// picture of another program, data missing or changed. Notes (start.notes) say what an older picture did not carry.
Result<Restored> restoreFrom(const std::filesystem::path& file);

}  // namespace welkin::app
