#pragma once
// Where a window lies on the desktop, and how one that would lie beside every monitor comes back to where it can be seen.
#include <optional>
#include <span>
#include <utility>

#include "welkin/app/options.h"

namespace welkin::window {

struct Placement {
  app::Size size;                               // of its content, in screen coordinates, while it is not maximised
  std::optional<std::pair<int, int>> position;  // of its content's upper left corner; none: as the desktop likes
  bool maximized = false;
};

struct Area {  // of a monitor that windows may cover, in screen coordinates
  int x, y, width, height;
};

// As it was if its upper edge can be seen and taken hold of; else moved into the nearest area. Never larger than that area. Without
// areas, or without a position, nothing changes but for its size.
Placement onto(std::span<const Area> areas, Placement wanted);

}  // namespace welkin::window
