#pragma once
// Replays a path as `welkin fly` does, in a thread with a GL of its own: to be looked at, to be measured, or into a video.
#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "welkin/app/flight.h"
#include "welkin/app/flight_result.h"

namespace welkin::window {

enum class FlightTask { Show, Measure, Film };
inline constexpr const char* kFlightTasks[] = {"exact replay", "benchmark", "video"};

class FlightJob {
 public:
  FlightJob() = default;
  ~FlightJob() { end(); }
  FlightJob(const FlightJob&) = delete;
  FlightJob& operator=(const FlightJob&) = delete;

  // What it writes lies beside the path, or in `otherwise` if nothing can be written there; never over another file. One at a time.
  void begin(FlightTask task, const std::filesystem::path& path, const std::filesystem::path& otherwise, const std::string& gpu);
  void stop() { stop_ = true; }  // after the frame that is being drawn; what it has written goes
  bool running() const { return running_; }
  bool stopping() const { return stop_; }
  FlightTask task() const { return task_; }

  struct Progress {
    double fraction = 0, since_s = 0;
    std::string note;
  };
  Progress progress() const;

  struct Picture {
    int frame;
    View view;
    double time_s;
    Image8 image;
  };
  std::optional<Picture> takePicture();  // of Show: each one in turn, and the next is not drawn before; of Film: the newest

  struct Done {
    FlightTask task;
    bool stopped = false;
    std::string said;  // one line: what was written, or what went wrong
    bool bad = false;
    std::optional<app::FlightResult> result;
  };
  std::optional<Done> takeDone();

 private:
  Done work(const std::filesystem::path& path, const std::filesystem::path& otherwise, const std::string& gpu);
  void show(Picture picture, double due_ms);
  void end();
  FlightTask task_ = FlightTask::Show;
  mutable std::mutex mutex_;
  std::condition_variable taken_;
  Progress progress_;
  double begun_ms_ = 0;
  std::optional<Picture> picture_;
  std::optional<Done> done_;
  std::atomic<bool> stop_{false};
  bool running_ = false;
  std::thread thread_;
};

}  // namespace welkin::window
