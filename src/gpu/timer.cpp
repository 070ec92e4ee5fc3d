#include "welkin/gpu/timer.h"

#include <glad/gl.h>

#include <ctime>
#include <utility>

namespace welkin::gpu {
namespace {
double clock_ms(clockid_t id) {
  timespec t{};
  clock_gettime(id, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}
}  // namespace

double processCpu_ms() { return clock_ms(CLOCK_PROCESS_CPUTIME_ID); }
double wall_ms() { return clock_ms(CLOCK_MONOTONIC); }

PassTimer::~PassTimer() {
  for (auto& p : pending_) glDeleteQueries(2, p.query);
}

void PassTimer::begin(const std::string& pass) {
  if (!enabled) return;
  current_ = pass;
  if (software_) {
    glFinish();
    wall0_ = wall_ms();
    cpu0_ = processCpu_ms();
  } else {
    glGenQueries(1, &query0_);
    glQueryCounter(query0_, GL_TIMESTAMP);
  }
}

void PassTimer::end() {
  if (!enabled) return;
  if (software_) {
    glFinish();
    PassTime& t = done_[current_];
    t.wall_ms += wall_ms() - wall0_;
    t.cpu_ms += processCpu_ms() - cpu0_;
  } else {
    Open open{current_, {query0_, 0}};
    glGenQueries(1, &open.query[1]);
    glQueryCounter(open.query[1], GL_TIMESTAMP);
    pending_.push_back(open);
  }
}

std::map<std::string, PassTime> PassTimer::collect() {
  for (auto& p : pending_) {
    GLuint64 t0 = 0, t1 = 0;
    glGetQueryObjectui64v(p.query[0], GL_QUERY_RESULT, &t0);
    glGetQueryObjectui64v(p.query[1], GL_QUERY_RESULT, &t1);
    glDeleteQueries(2, p.query);
    done_[p.name].wall_ms += static_cast<double>(t1 - t0) * 1e-6;
  }
  pending_.clear();
  return std::exchange(done_, {});
}

}  // namespace welkin::gpu
