#include "welkin/stream/streamer.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

namespace welkin {

// One worker, one queue in, one map out. The lock covers queue and map alone: never a step, never a density evaluation.
struct Streamer::Impl {
  Impl(const DensitySource& source, const RootFrame& root, const StreamSettings& settings, std::uint32_t jitterSeed)
      : state(source, root, settings), random(jitterSeed), jitter(jitterSeed != 0) {
    worker = std::jthread([this](const std::stop_token& stop) { work(stop); });
  }

  void work(const std::stop_token& stop) {
    std::unique_lock lock(mutex);
    while (changed.wait(lock, stop, [&] { return !inputs.empty(); })) {
      FrameInput input = std::move(inputs.front());
      inputs.pop_front();
      if (jitter) {
        const auto nap = std::chrono::microseconds(std::uniform_int_distribution<int>(0, 4000)(random));
        changed.wait_for(lock, stop, nap, [] { return false; });
        if (stop.stop_requested()) return;
      }
      lock.unlock();
      FrameEdits edits;
      std::exception_ptr thrown;
      try {
        edits = state.step(input);
      } catch (...) {
        thrown = std::current_exception();
      }
      lock.lock();
      expected.erase(input.frame);
      if (thrown) {
        failure = thrown;
        changed.notify_all();
        return;
      }
      outputs.insert_or_assign(input.frame, std::move(edits));
      changed.notify_all();
    }
  }

  StreamState state;
  std::mt19937 random;
  const bool jitter;
  mutable std::mutex mutex;
  std::condition_variable_any changed;
  std::deque<FrameInput> inputs;
  std::set<std::uint64_t> expected;  // frames posted, not done
  std::map<std::uint64_t, FrameEdits> outputs;
  std::exception_ptr failure;
  std::jthread worker;  // last: it stops before the rest is gone
};

Streamer::Streamer(const DensitySource& source, const RootFrame& root, StreamSettings settings, std::uint32_t jitterSeed)
    : impl_(std::make_unique<Impl>(source, root, settings, jitterSeed)) {}

Streamer::~Streamer() = default;

void Streamer::post(FrameInput input) {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->expected.insert(input.frame);
    impl_->inputs.push_back(std::move(input));
  }
  impl_->changed.notify_all();
}

bool Streamer::ready(std::uint64_t frame) const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->outputs.contains(frame);
}

FrameEdits Streamer::take(std::uint64_t frame) {
  std::unique_lock lock(impl_->mutex);
  impl_->changed.wait(lock, [&] { return impl_->outputs.contains(frame) || impl_->failure || !impl_->expected.contains(frame); });
  const auto found = impl_->outputs.find(frame);
  if (found == impl_->outputs.end()) {
    if (impl_->failure) std::rethrow_exception(impl_->failure);
    throw std::logic_error("streamer: frame " + std::to_string(frame) + " was never posted, or was taken before");
  }
  FrameEdits edits = std::move(found->second);
  impl_->outputs.erase(found);
  return edits;
}

}  // namespace welkin
