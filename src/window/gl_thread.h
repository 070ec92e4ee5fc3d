#pragma once
// A second thread with a context of its own that shares objects with the window's: what takes long to make is made here, so that the
// window never waits. Jobs run one after another; what a job made is whole when it ends.
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

#include "welkin/gpu/program.h"

struct GLFWwindow;

namespace welkin::window {

class GlThread {
 public:
  GlThread(GLFWwindow* shared, std::shared_ptr<gpu::ProgramPool> pool);
  ~GlThread();  // after the job that runs, without those that wait
  void run(std::function<void()> job);
  std::uint64_t glMessages() const { return glMessages_; }

 private:
  void work();
  GLFWwindow* shared_;
  std::shared_ptr<gpu::ProgramPool> pool_;
  std::mutex mutex_;
  std::condition_variable more_;
  std::deque<std::function<void()>> jobs_;
  bool stop_ = false;
  std::atomic<std::uint64_t> glMessages_{0};
  std::thread thread_;
};

}  // namespace welkin::window
