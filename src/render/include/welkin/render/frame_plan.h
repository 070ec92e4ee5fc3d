#pragma once
// Which passes and data a scene and a view need, and for each one left out the reason in words. What the scene never needs is not
// compiled, not allocated and not run; what this view does not need is not run. In doubt it runs. docs/left-out.md measures each reason.
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "welkin/physics/scene.h"

namespace welkin {

struct LeftOut {
  std::string what;    // "octree, bricks, light, march"
  std::string reason;  // "no clouds in the scene"
  std::string name;    // of the reason: "no-clouds"
};

// What is asked of a renderer.
struct PlanFor {
  std::optional<View> view = {};      // seen from here; none: from anywhere
  bool onePicture = false;            // of this view, and no other
  bool linear = true;                 // radiance() will be read
  double aspect = 16.0 / 9;           // of the picture
  std::set<std::string> forced = {};  // names of reasons that are not to hold
};

struct FramePlan {
  bool clouds = false;   // octree, bricks, maps, march
  bool air = false;      // sky tables and aerial perspective
  bool sun = false;      // light from the sun, its disc, shadows
  bool metered = false;  // histogram, adaptation, tone mapping in a pass of its own
  bool history = false;  // reprojection
  bool ground = true;    // a ray may meet it
  bool albedoMap = true; // and its picture is seen
  bool linear = true;    // the picture is kept before exposure, too
  bool aux = true;       // somebody reads how far away clouds are, and their shadow on the ground
  bool oneLayer = false;       // of clouds, whatever the type of the weather
  bool everyHarmonic = false;  // tables of diffuse light as for peaked layers, whatever the layers are
  bool sunMayMove = false;     // light as it comes, and what makes it is kept
  bool redraw = true;          // a frame equal to the last one is drawn all the same
  std::string skyModel, skyReason;  // which tables of the sky, and why; empty without air
  std::vector<std::string> passes;  // in order
  std::vector<LeftOut> leftOut;
};

FramePlan planFrame(const Scene& scene, const PlanFor& asked = {});

// Every name that LeftOut::name can have: each has a scene benchmarks/left-out/NAME.json.
const std::vector<std::string>& leftOutReasons();

// The scene with nothing in the place of what it has not, for reasons that are forced not to hold: passes then have something to run on.
Scene sceneFor(const Scene& scene, const std::set<std::string>& forced);

// What rays of a view may meet. Cones about the picture, so true is no promise and false is one.
struct Sight {
  bool shell = true;   // the planet, its air or its clouds
  bool ground = true;
  bool lit = true;     // anything that light of the sun reaches, scattered four times at most
};
Sight sightOf(const Scene& scene, const View& view, double aspect);

// Why nothing but space, sun and black ground is seen in this view, if so. Cheap: asked in every frame.
std::optional<LeftOut> nothingSeen(const Scene& scene, const PlanFor& asked);

}  // namespace welkin
