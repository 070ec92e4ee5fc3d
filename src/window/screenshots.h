#pragma once
// Pictures of the window's view, written by a thread: as seen, or converged (drawn anew by a GL of its own, docs/window.md).
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "welkin/app/options.h"
#include "welkin/app/picture.h"
#include "welkin/render/renderer.h"

namespace welkin::window {

class Screenshots {
 public:
  Screenshots(std::filesystem::path folder, std::string gpu);
  ~Screenshots();  // after what is being written; a picture still being drawn is given up

  void takeAsSeen(Image8 image, app::PictureState state);  // checksums of data are added
  void takeConverged(const Scene& scene, const View& view, app::Size size, double time_s);  // PNG and EXR
  struct Note {
    std::string text;
    bool bad;
  };
  std::vector<Note> news();  // since the last call
  bool busy() const;

 private:
  void add(std::function<Result<std::string>()> job);
  void work();
  std::filesystem::path folder_;
  std::string gpu_;
  mutable std::mutex mutex_;
  std::condition_variable more_;
  std::deque<std::function<Result<std::string>()>> jobs_;
  std::vector<Note> notes_;
  std::atomic<bool> stop_{false};
  bool working_ = false;
  std::thread thread_;
};

}  // namespace welkin::window
