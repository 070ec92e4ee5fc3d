#include "welkin/gpu/memory.h"

namespace welkin::gpu {

bool MemoryAccount::charge(const std::string& what, std::uint64_t bytes, bool frameTarget) {
  if (!frameTarget && bytes > budget_ - used_) return false;
  (frameTarget ? targets_ : used_) += bytes;
  byName_[what] += bytes;
  return true;
}

void MemoryAccount::release(const std::string& what, std::uint64_t bytes, bool frameTarget) {
  (frameTarget ? targets_ : used_) -= bytes;
  const auto it = byName_.find(what);
  if (it == byName_.end()) return;
  it->second -= bytes;
  if (it->second == 0) byName_.erase(it);
}

}  // namespace welkin::gpu
