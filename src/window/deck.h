#pragma once
// The flight that is recorded, edited and played: what the panel "Flight" works on.
#include <filesystem>
#include <string>

#include "welkin/app/recorder.h"
#include "welkin/app/tape.h"

namespace welkin::window {

class Deck {
 public:
  enum class Mode { Idle, Recording, Playing };
  Mode mode() const { return mode_; }
  void record();  // in place of what is on the tape, once it ends
  // What was recorded comes onto the tape, at a fixed step: from here on each frame stays as it is, to the bit.
  Result<void> endRecording(const std::string& name, int width, int height);
  void load(FlightPath path);
  void play();  // from where it stands, or from the in point
  void stop() { mode_ = Mode::Idle; }
  void moveTo(double at_s);

  // Of a frame of the window. False: the recording is full, and has ended.
  bool add(double dt_s, const View& view, double time_s);
  PathFrame advance(double dt_s);  // playing

  app::Tape tape;
  bool loop = false;
  double at_s() const { return at_s_; }  // from the first frame; while recording: its length
  double in_s() const { return tape.in() * tape.step_s(); }
  double out_s() const { return tape.out() * tape.step_s(); }
  void keepBetween();

  // The file that the tape was last saved as, or came from; empty if it, or the scene, is another one by now.
  std::filesystem::path fileOf(const std::string& scene) const;
  void saved(const std::filesystem::path& file, const std::string& scene) { file_ = file, savedTape_ = tape, savedScene_ = scene; }

 private:
  Mode mode_ = Mode::Idle;
  app::Recording recording_;
  double at_s_ = 0;
  std::filesystem::path file_;
  app::Tape savedTape_;
  std::string savedScene_;
};

}  // namespace welkin::window
