#pragma once
// Qualities by name; docs/presets.md has what each costs and how far it is from the truth.
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "welkin/physics/scene.h"

namespace welkin::app {

struct Preset {
  const char* name;
  std::uint64_t budget_bytes;
  double step, spread;
};
inline constexpr std::array<Preset, 4> kPresets{{
    {"low", 128ull << 20, 0.64, 8},
    {"medium", 512ull << 20, 0.32, 8},
    {"high", 1ull << 30, 0.16, 4},
    {"ultra", 2ull << 30, 0.08, 0},
}};

// Budget, step, spread and detail of the preset; integrator, step rule and skipping of the best kind. Depth and seed are the scene's: they
// say what there is to see, not how well.
void apply(const Preset& preset, Quality& quality);
// The name of the preset that this is, one of `own` first; empty: none of them.
std::string presetOf(const Quality& quality, const std::map<std::string, Quality>& own = {});
// Makes it so by name; false, and nothing changes: there is none of that name.
bool applyPreset(std::string_view name, Quality& quality, const std::map<std::string, Quality>& own = {});

}  // namespace welkin::app
