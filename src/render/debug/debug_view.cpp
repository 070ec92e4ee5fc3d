#include "welkin/render/debug_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "welkin/shared/debug.glsl.h"
#include "welkin/shared/octree.glsl.h"

namespace welkin {

const DebugTopic& debugTopic(DebugView view) {
  using namespace shared;
  static const std::array<DebugTopic, kDebugViewNames.size()> topics{{
      {"the picture", ""},
      {"samples of bricks along the ray", "samples", 1, kDebugSteps, true},
      {"level of the octree where the ray loses most of its light", "level", 0, 0, false, kMaxDepth + 1},
      {"share of the ray's way between the clouds' base and top that is in nodes with cloud; the rest was skipped", "", 0, 1},
      {"where the pixel's clouds came from", "kind", 0, 0, false, kHistoryKinds},
      {"greatest extinction along the ray", "1/m", kDebugThinnest_per_m, kDebugThickest_per_m, true},
      {"share of the sun's light that reaches, through clouds, what the ray sees", "", 0, 1},
      {"the picture without clouds; numbers are of its luminance before exposure", "1/sr"},
      {"pixels that are not a number, infinite or negative", "kind", 0, 0, false, 3},
  }};
  return topics[std::size_t(view)];
}

std::string debugKindName(DebugView view, unsigned kind) {
  constexpr std::array<const char*, shared::kHistoryKinds> history{"marched in its turn", "marched: no valid history",
                                                                   "of 1 to 4 frames before", "of 5 to 10", "of more"};
  constexpr std::array<const char*, 3> nan{"right", "not a number or infinite", "negative"};
  if (view == DebugView::History && kind < history.size()) return history[kind];
  if (view == DebugView::Nan && kind < nan.size()) return nan[kind];
  return fmt::format("level {}", kind);
}

DebugNumbers debugNumbers(DebugView view, const std::vector<float>& values) {
  DebugNumbers out;
  out.view = view;
  out.kinds.resize(debugTopic(view).kinds);
  for (const float value : values) {
    if (std::isnan(value)) ++out.nan;
    if (value < 0) ++out.without;
    if (!(value >= 0)) continue;
    out.minimum = out.pixels ? std::min(out.minimum, double(value)) : double(value);
    out.maximum = std::max(out.maximum, double(value));
    out.mean += double(value);
    ++out.pixels;
    if (const auto kind = std::size_t(value); kind < out.kinds.size()) ++out.kinds[kind];
  }
  if (out.pixels) out.mean /= double(out.pixels);
  return out;
}

std::string debugValueText(const DebugTopic& topic, double value) {
  if (topic.kinds) return fmt::format("{:.3g}", value);
  return *topic.unit ? fmt::format("{:.3g} {}", value, topic.unit) : fmt::format("{:.3g} %", 100 * value);
}

std::string debugText(const DebugNumbers& n) {
  const DebugTopic& topic = debugTopic(n.view);
  std::string out;
  if (n.view != DebugView::History && n.view != DebugView::Nan && n.pixels)
    out =
        fmt::format("{} to {}, mean {}", debugValueText(topic, n.minimum), debugValueText(topic, n.maximum), debugValueText(topic, n.mean));
  for (unsigned i = 0; i < topic.kinds && n.view != DebugView::Detail; ++i)
    out += fmt::format("{}{}: {}", out.empty() ? "" : ", ", debugKindName(n.view, i), n.kinds[i]);
  if (n.without) out += fmt::format("{}{} pixels without", out.empty() ? "" : ", ", n.without);
  if (n.nan) out += fmt::format(", {} not a number", n.nan);
  return out;
}

}  // namespace welkin
