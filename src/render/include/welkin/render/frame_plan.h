#pragma once
// Which passes and data a scene needs, and for each one left out the reason in words. What is left out is not compiled, not
// allocated and not run.
#include <string>
#include <vector>

#include "welkin/physics/scene.h"

namespace welkin {

struct LeftOut {
  std::string what;    // "octree, bricks, light, march"
  std::string reason;  // "no clouds in the scene"
};

struct FramePlan {
  bool clouds = false;  // octree, bricks, light, maps, march, reprojection
  bool air = false;     // sky tables and aerial perspective
  bool sun = false;     // light from the sun, its disc, shadows
  bool metered = false;  // histogram, adaptation, tone mapping in a pass of its own
  std::string skyModel, skyReason;  // which tables of the sky, and why; empty without air
  std::vector<std::string> passes;  // in order
  std::vector<LeftOut> leftOut;
};

FramePlan planFrame(const Scene& scene);

}  // namespace welkin
