#pragma once
// What each reason of a plan saves: the same picture with the reason and with the reason forced not to hold, in turns.
#include <string>
#include <vector>

#include "welkin/app/draw.h"

namespace welkin::app {

struct Sides {  // medians over the turns: as planned, and with the reason forced not to hold
  double leftOut = 0, forced = 0;
  double saved() const { return forced > 0 ? 1 - leftOut / forced : 0; }
};

struct Saving {
  LeftOut reason;
  bool flight = false;      // asked: a flight; else one picture
  Sides start_ms, frame_ms; // to the first whole picture; each frame after it. Software GL: CPU time of all threads, else wall time
  Sides bytes;              // of GL memory, of the brick pool what is in use
  int maxDifference_255 = 0;
  double most() const;
};

struct MeasureSettings {
  Size size;
  int turns = 3, frames = 8;
};

// `asked` says whether one picture or a flight is asked for; each reason must hold for it.
Result<Saving> measureReason(gpu::Context& context, const Start& start, const PlanFor& asked, const LeftOut& reason, const MeasureSettings& how);

}  // namespace welkin::app
