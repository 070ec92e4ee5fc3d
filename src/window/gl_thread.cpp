#include "gl_thread.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <glad/gl.h>

#include "welkin/gpu/context.h"

namespace welkin::window {

GlThread::GlThread(GLFWwindow* shared, std::shared_ptr<gpu::ProgramPool> pool)
    : shared_(shared), pool_(std::move(pool)), thread_([this] { work(); }) {}

GlThread::~GlThread() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  more_.notify_one();
  thread_.join();
}

void GlThread::run(std::function<void()> job) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  more_.notify_one();
}

void GlThread::work() {
  glfwMakeContextCurrent(shared_);
  gpu::usePool(pool_);
  {
    const auto context = gpu::Context::ofCurrent();  // counts this context's messages
    for (;;) {
      std::unique_lock lock(mutex_);
      more_.wait(lock, [this] { return stop_ || !jobs_.empty(); });
      if (stop_) break;
      const std::function<void()> job = std::move(jobs_.front());
      jobs_.pop_front();
      lock.unlock();
      job();
      glFinish();
      if (context) glMessages_ = (*context)->debugMessages();
    }
    jobs_.clear();
  }
  glfwMakeContextCurrent(nullptr);
}

}  // namespace welkin::window
