#pragma once
// Hands out indices below a capacity. The limit lives here: an allocation that does not fit fails, nothing cleans up later.
// The order is deterministic: last released, first reused; once all are released the pool is as new.
#include <cassert>
#include <cstdint>
#include <optional>
#include <vector>

namespace welkin {

template <class Index>
class IndexPool {
 public:
  // Indices first .. capacity - 1 are handed out; those below `first` are reserved for the owner and count as used.
  IndexPool(std::uint32_t capacity, std::uint32_t first) : capacity_(capacity), first_(first), next_(first) {}

  std::optional<Index> allocate() {
    std::uint32_t index;
    if (!free_.empty()) {
      index = free_.back();
      free_.pop_back();
    } else if (next_ < capacity_) {
      index = next_++;
      if (live_.size() < next_) live_.resize(next_, false);
    } else {
      return std::nullopt;
    }
    live_[index] = true;
    ++allocated_;
    return Index{index};
  }

  // The index must be allocated.
  void release(Index index) {
    assert(isLive(index));
    live_[index.value] = false;
    --allocated_;
    if (allocated_ == 0) {
      free_.clear();
      next_ = first_;
    } else {
      free_.push_back(index.value);
    }
  }

  bool isLive(Index index) const { return index.value >= first_ && index.value < next_ && live_[index.value]; }
  std::uint32_t capacity() const { return capacity_; }
  std::uint32_t used() const { return first_ + allocated_; }
  std::uint32_t available() const { return capacity_ - used(); }
  std::uint32_t highWater() const { return next_; }  // no live index is at or above it
  bool pristine() const { return allocated_ == 0 && free_.empty() && next_ == first_; }
  std::size_t bytes() const { return free_.capacity() * sizeof(std::uint32_t) + live_.capacity() / 8; }

 private:
  std::uint32_t capacity_, first_, next_;
  std::uint32_t allocated_ = 0;
  std::vector<std::uint32_t> free_;
  std::vector<bool> live_;
};

}  // namespace welkin
