#pragma once
// A flight that is being edited: one pose a frame at a fixed step, in and out points, and cuts that can be taken back.
#include <memory>
#include <string>
#include <vector>

#include "welkin/app/edit_history.h"
#include "welkin/physics/path_io.h"

namespace welkin::app {

class Tape {
 public:
  Tape() : Tape(FlightPath{}) {}
  explicit Tape(FlightPath path);  // in and out at its ends

  bool empty() const { return all().empty(); }
  int frames() const { return int(all().size()); }
  double step_s() const;  // between frames, over 0
  double duration_s() const { return empty() ? 0 : step_s() * (frames() - 1); }
  // The pose at a time from the first frame, between two frames if need be; on a frame it is that one to the bit. Not of an empty tape.
  PathFrame at(double time_s) const;

  // First and last frame that are kept. A point that is moved past the other one stops there.
  int in() const { return history_.current().in; }
  int out() const { return history_.current().out; }
  void setIn(int frame);
  void setOut(int frame);
  void letGo() { history_.settle(); }  // the next move is an edit of its own
  void keepBetween();                  // throws away what lies outside of the points

  bool canUndo() const { return history_.canUndo(); }
  bool canRedo() const { return history_.canRedo(); }
  const std::string& undoes() const { return history_.undoes(); }
  std::string redoes() const { return history_.redoes(); }
  void undo() { history_.undo(); }
  void redo() { history_.redo(); }

  // The same frames, between the same points?
  bool same(const Tape& other) const;
  // From the in to the out point, each frame as it was to the bit, with the path's other fields.
  FlightPath path() const;

 private:
  struct State {
    std::shared_ptr<const std::vector<PathFrame>> frames;  // shared: most edits change the points alone
    int in = 0, out = 0;
  };
  static State whole(std::vector<PathFrame> frames);
  const std::vector<PathFrame>& all() const { return *history_.current().frames; }
  FlightPath head_;  // without its frames
  EditHistory<State> history_;
};

}  // namespace welkin::app
