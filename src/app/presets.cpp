#include "welkin/app/presets.h"

#include <tuple>

namespace welkin::app {
namespace {

// All that a preset decides.
auto decided(const Quality& q) { return std::tie(q.budget_bytes, q.integrator, q.stepRule, q.step, q.skipEmpty, q.spread, q.detail); }

void take(const Quality& from, Quality& to) {
  const auto [depth, seed] = std::pair(to.depth, to.seed);
  to = from;
  to.depth = depth;
  to.seed = seed;
}

}  // namespace

void apply(const Preset& preset, Quality& quality) {
  Quality wanted;
  wanted.budget_bytes = preset.budget_bytes;
  wanted.step = preset.step;
  wanted.spread = preset.spread;
  take(wanted, quality);
}

std::string presetOf(const Quality& quality, const std::map<std::string, Quality>& own) {
  for (const auto& [name, q] : own) {
    if (decided(q) == decided(quality)) return name;
  }
  for (const Preset& preset : kPresets) {
    Quality q;
    apply(preset, q);
    if (decided(q) == decided(quality)) return preset.name;
  }
  return {};
}

bool applyPreset(std::string_view name, Quality& quality, const std::map<std::string, Quality>& own) {
  if (const auto found = own.find(std::string(name)); found != own.end()) {
    take(found->second, quality);
    return true;
  }
  for (const Preset& preset : kPresets) {
    if (name != preset.name) continue;
    apply(preset, quality);
    return true;
  }
  return false;
}

}  // namespace welkin::app
