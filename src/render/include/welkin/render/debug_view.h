#pragma once
// Pictures of how the renderer works, in false colours (docs/debug-views.md).
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace welkin {

enum class DebugView { None, Steps, Detail, Occupancy, History, Density, Light, Air, Nan };  // as WK_DEBUG_... in shared/debug.glsl.h
inline constexpr std::array<const char*, 9> kDebugViewNames{"none",    "steps", "detail", "occupancy", "history",
                                                            "density", "light", "air",    "nan"};

// What a view's values are.
struct DebugTopic {
  const char* what = "";     // of a pixel
  const char* unit = "";     // empty: a share
  double low = 0, high = 0;  // ends of the scale; equal: there is none
  bool logarithmic = false;
  unsigned kinds = 0;  // values are numbers of kinds, 0 to this; 0: they are not
};
const DebugTopic& debugTopic(DebugView view);
std::string debugKindName(DebugView view, unsigned kind);

// Of the pixels that have a value. Without one are pixels whose ray met no clouds.
struct DebugNumbers {
  DebugView view = DebugView::None;
  std::uint64_t pixels = 0, without = 0, nan = 0;
  double minimum = 0, mean = 0, maximum = 0;
  std::vector<std::uint64_t> kinds;  // pixels of each
};
DebugNumbers debugNumbers(DebugView view, const std::vector<float>& values);
std::string debugText(const DebugNumbers& numbers);                 // one line
std::string debugValueText(const DebugTopic& topic, double value);  // with its unit

}  // namespace welkin
