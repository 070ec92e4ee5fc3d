#pragma once
// Every GL allocation is charged here, so bytes in use never pass the budget: an allocation over it fails instead.
#include <cstdint>
#include <map>
#include <string>

namespace welkin::gpu {

class MemoryAccount {
 public:
  explicit MemoryAccount(std::uint64_t budget_bytes) : budget_(budget_bytes) {}
  bool charge(const std::string& what, std::uint64_t bytes, bool frameTarget = false);  // false: over the budget, not charged
  void release(const std::string& what, std::uint64_t bytes, bool frameTarget = false);
  std::uint64_t budget() const { return budget_; }
  std::uint64_t used() const { return used_; }              // under the budget
  std::uint64_t frameTargets() const { return targets_; }   // frame targets, reported apart
  const std::map<std::string, std::uint64_t>& byName() const { return byName_; }

 private:
  std::uint64_t budget_, used_ = 0, targets_ = 0;
  std::map<std::string, std::uint64_t> byName_;
};

}  // namespace welkin::gpu
