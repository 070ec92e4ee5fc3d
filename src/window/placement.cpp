#include "welkin/window/placement.h"

#include <algorithm>
#include <limits>

namespace welkin::window {
namespace {

constexpr int kHold_px = 120;  // so much of the upper edge must be there for a hand to take
constexpr int kTitle_px = 40;  // room for a title bar above the content, where a window is brought back

long long distance2(const Area& a, int x, int y) {
  const long long dx = std::max({a.x - x, x - (a.x + a.width), 0}), dy = std::max({a.y - y, y - (a.y + a.height), 0});
  return dx * dx + dy * dy;
}

bool reachable(const Area& a, int x, int y, int width) {
  const int seen = std::min(x + width, a.x + a.width) - std::max(x, a.x);
  return seen >= std::min(width, kHold_px) && y >= a.y && y < a.y + a.height - kTitle_px;
}

}  // namespace

Placement onto(std::span<const Area> areas, Placement wanted) {
  if (areas.empty()) return wanted;
  const Area* nearest = &areas.front();
  if (wanted.position) {
    const auto [x, y] = *wanted.position;
    long long least = std::numeric_limits<long long>::max();
    for (const Area& a : areas)
      if (const auto d = distance2(a, x + wanted.size.width / 2, y); d < least) least = d, nearest = &a;
  }
  wanted.size.width = std::min(wanted.size.width, nearest->width);
  wanted.size.height = std::min(wanted.size.height, nearest->height);
  if (!wanted.position) return wanted;
  auto& [x, y] = *wanted.position;
  if (std::any_of(areas.begin(), areas.end(), [&](const Area& a) { return reachable(a, x, y, wanted.size.width); })) return wanted;
  x = std::clamp(x, nearest->x, nearest->x + nearest->width - wanted.size.width);
  const int room = nearest->height - wanted.size.height;
  y = std::clamp(y, nearest->y + std::min(kTitle_px, room), nearest->y + room);
  return wanted;
}

}  // namespace welkin::window
