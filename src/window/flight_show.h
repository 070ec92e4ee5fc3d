#pragma once
// Flights replayed as `welkin fly` does, in the window: begun and stopped as the panel asks, their pictures shown one by one.
#include "flight_job.h"
#include "model.h"
#include "presenter.h"

namespace welkin::window {

class FlightShow {
 public:
  explicit FlightShow(std::string gpu) : gpu_(std::move(gpu)) {}
  void begin(Model& model, FlightTask task, const std::filesystem::path& path, const std::filesystem::path& otherwise);
  // Once a frame: takes what there is.
  void advance(Model& model);
  bool running() const { return job_.running(); }
  // A picture of the flight is to be seen, not one of the window's own renderer: while it runs, and its last one until one moves on.
  bool shows(const View& view) const;
  void moveOn() { held_ = running() && held_; }
  void draw(const Presenter& presenter, app::Size window) const { presenter.showWhole(texture_, window); }

  struct Shown {  // for tests
    int frame;
    View view;
    std::string sha256;  // of the picture's bytes
  };
  const std::vector<Shown>& shown() const { return shown_; }
  void rememberShown() { remembers_ = true; }

 private:
  void take(Model& model, FlightJob::Picture picture);
  std::string gpu_;
  FlightJob job_;
  gpu::MemoryAccount account_{~0ull};
  gpu::Texture texture_;
  bool held_ = false, remembers_ = false;
  View view_;
  std::vector<Shown> shown_;
};

}  // namespace welkin::window
