#include "flight_job.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <chrono>

#include "welkin/app/places.h"
#include "welkin/core/files.h"
#include "welkin/gpu/timer.h"

namespace welkin::window {
namespace fs = std::filesystem;
namespace {

constexpr auto kLook = std::chrono::milliseconds(20);  // so often is a stop looked for

struct Output {
  const char *suffix, *extension, *what;
};
Output outputOf(FlightTask task) {
  return task == FlightTask::Measure ? Output{"-result", ".json", "result"} : Output{"", ".mp4", "video"};
}

// Beside the path, or in the other folder.
Result<fs::path> newFile(const fs::path& path, const fs::path& otherwise, const Output& output) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const std::string name = path.stem().string() + output.suffix;
  auto stem = app::reserveFiles(folder, name, {output.extension});
  if (!stem) stem = app::reserveFiles(otherwise, name, {output.extension});
  if (!stem) return stem.error();
  return fs::path(stem->string() + output.extension);
}

}  // namespace

void FlightJob::begin(FlightTask task, const fs::path& path, const fs::path& otherwise, const std::string& gpu) {
  end();
  task_ = task;
  stop_ = false;
  running_ = true;
  progress_ = {0, 0, "reading the path"};
  begun_ms_ = gpu::wall_ms();
  thread_ = std::thread([this, path, otherwise, gpu] {
    Done done{task_, true, {}, false, {}};
    try {
      done = work(path, otherwise, gpu);
    } catch (const std::exception& e) {
      done.said = oneLine(e.what());
    }
    const std::lock_guard lock(mutex_);
    done_ = std::move(done);
    glfwPostEmptyEvent();
  });
}

FlightJob::Done FlightJob::work(const fs::path& path, const fs::path& otherwise, const std::string& gpu) {
  Done done{task_, false, {}, false, {}};
  const auto failed = [&](const Error& error) {
    done.bad = true, done.said = error.message;
    return done;
  };
  app::FlightOptions options;
  options.path = path;
  std::error_code none;
  options.out = fs::temp_directory_path(none);  // nothing is written there
  if (none) options.out = otherwise;
  options.every = 0;
  options.common.gpu = gpu;
  options.command = "welkin view, panel Flight";
  fs::path output;
  if (task_ != FlightTask::Show) {
    const auto made = newFile(path, otherwise, outputOf(task_));
    if (!made) return failed(made.error());
    output = *made;
    (task_ == FlightTask::Film ? options.video : options.common.json) = output;
    options.out = output.has_parent_path() ? output.parent_path() : fs::path(".");
  }
  const auto drop = [&] {
    std::error_code ec;
    if (!output.empty()) fs::remove(output, ec);
  };
  const auto plan = app::planFlight(options);
  if (!plan) return drop(), failed(plan.error());
  app::FlightWatch watch;
  watch.progress = [this](double fraction, const std::string& note) {
    const std::lock_guard lock(mutex_);
    progress_ = {fraction, 0, note};
    return !stop_;
  };
  double first_ms = -1;
  if (task_ != FlightTask::Measure) {
    watch.picture = [&](int frame, const Image8& image) {
      if (first_ms < 0) first_ms = gpu::wall_ms();
      const PathFrame& pose = plan->path.frames[std::size_t(frame)];
      show({frame, pose.view, pose.time_s, image}, first_ms + 1000 * plan->path.timeStep_s * (frame - plan->first));
    };
  }
  const auto report = app::replay(options, *plan, watch);
  if (!report) return drop(), failed(report.error());
  done.stopped = report->stopped;
  if (report->stopped) {
    drop();
    done.said = fmt::format("stopped after {} of {} frames", report->frames.size(), plan->end - plan->first);
    return done;
  }
  if (task_ == FlightTask::Measure) {
    const std::string json = report->json() + "\n";
    if (auto written = writeFile(output, json); !written) return drop(), failed(written.error());
    auto read = app::parseFlightResult(json, output.string());
    if (!read) return failed(read.error());
    done.result = std::move(*read);
  }
  done.said = output.empty() ? fmt::format("{} frames shown as `welkin fly` draws them", report->frames.size())
                             : fmt::format("wrote the {}: {}", outputOf(task_).what, output.string());
  return done;
}

// One that was flown at a step is not shown faster than that.
void FlightJob::show(Picture picture, double due_ms) {
  std::unique_lock lock(mutex_);
  if (task_ == FlightTask::Show) {
    while (!stop_ && (picture_ || gpu::wall_ms() < due_ms)) {
      const auto left = std::chrono::duration<double, std::milli>(picture_ ? 20.0 : std::max(due_ms - gpu::wall_ms(), 0.1));
      taken_.wait_for(lock, std::min<std::chrono::duration<double, std::milli>>(kLook, left));
    }
  }
  picture_ = std::move(picture);
  glfwPostEmptyEvent();
}

FlightJob::Progress FlightJob::progress() const {
  const std::lock_guard lock(mutex_);
  Progress p = progress_;
  p.since_s = (gpu::wall_ms() - begun_ms_) / 1000;
  return p;
}

std::optional<FlightJob::Picture> FlightJob::takePicture() {
  const std::lock_guard lock(mutex_);
  taken_.notify_one();
  return std::exchange(picture_, std::nullopt);
}

std::optional<FlightJob::Done> FlightJob::takeDone() {
  {
    const std::lock_guard lock(mutex_);
    if (!done_ || (picture_ && !stop_)) return {};  // the last picture comes first
  }
  end();
  return std::exchange(done_, std::nullopt);
}

void FlightJob::end() {
  stop_ = true;
  taken_.notify_one();
  if (thread_.joinable()) thread_.join();
  running_ = false;
}

}  // namespace welkin::window
