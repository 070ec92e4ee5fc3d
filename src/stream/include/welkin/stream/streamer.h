#pragma once
// The octree around the camera, kept under a budget. StreamState::step is a pure, single-threaded machine: what went in at
// frames 0..k decides what comes out, so a flight gives the same tree whatever the timing. Streamer runs it on a worker thread.
// Selection decides, streaming obeys, the GPU stores: the worker never touches GL.
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <vector>

#include "welkin/clouds/density_source.h"
#include "welkin/clouds/opaque_deck.h"
#include "welkin/physics/root_frame.h"
#include "welkin/shared/octree.glsl.h"

namespace welkin {

// What selection needs of a camera. Planet frame, metres, radians.
struct SelectionCamera {
  glm::dvec3 position_m{};
  glm::dvec3 forward{0, 0, -1}, right{1, 0, 0}, up{0, 1, 0};  // unit
  double tanHalfFovY = 0.5, tanHalfFovX = 0.5;
  double pixelDetail = 1e6;  // K past which voxels are finer than pixels: rays do not sample finer, whatever is resident
};

struct StreamSettings {
  std::uint32_t depth = 16;          // deepest level, 1..24
  std::uint32_t brickCapacity = 0;   // bricks in the pool, the zero brick included
  std::uint32_t groupCapacity = 0;   // groups of eight nodes in the node pool, the root's group included
  double detailLimit = 0;            // greatest node-edges-per-distance K; 0: no limit but the budget
  std::optional<OpaqueDeck> deck = {};  // what is below it is not refined while the camera is above
};

// What the GPU found when it generated a brick: extinction as a fraction of the source's maximum, over the stored corners.
struct BrickResult {
  std::uint32_t brick;
  float min, max;
  float minAltitude_m, maxAltitude_m;  // of the non-zero corners, one voxel of margin included; +inf,-inf if none
};

struct BrickJob {
  std::uint32_t brick;
  glm::uvec3 corner;
  std::uint32_t level;
};

struct NodeWrite {
  std::uint32_t node;
  shared::NodeWords words;
};

struct DirtyNode {  // everything below this node may look different to a ray
  glm::uvec3 corner;
  std::uint32_t level;
};

struct ResidencyStats {
  std::uint32_t nodes = 0, groups = 0, bricks = 0, brickCapacity = 0, emptyNodes = 0, pendingBricks = 0;
  std::uint32_t bricksByLevel[shared::kMaxDepth + 1] = {};
  std::uint64_t cpuBytes = 0;
  double selectedDetail = 0;  // K that the budget allowed
  bool settled = false;       // nothing is pending and selection wants nothing else
};

struct FrameInput {
  std::uint64_t frame = 0;
  SelectionCamera camera;
  std::uint32_t maxBricks = 256;         // most bricks to generate in this frame's edits
  std::vector<BrickResult> results;      // of jobs handed out by earlier edits, in the order they were handed out
  double detailLimit = 0;                // like StreamSettings', and under it, from now on; 0: that one alone
  bool snap = false;                     // a cut: let the sampled detail follow at once instead of gliding
  glm::dvec3 toSun{0};                   // unit, the tree's frame: light goes with it (src/stream/relight.h); 0: there is none
};

// To be executed in this order: store `nodes`, rebuild maps under `dirty`, light `light`, draw; `generate` before or after.
struct FrameEdits {
  std::uint64_t frame = 0;
  std::vector<BrickJob> generate;        // nearest first
  std::vector<NodeWrite> nodes;
  std::vector<DirtyNode> dirty;
  std::vector<BrickJob> light;           // bricks that the node writes of this frame made visible, or some frames ago: once more
  glm::dvec3 oldestSun{0};               // where the sun stood when the oldest light in the tree was asked for; 0: there is none
  float sampleDetail = 1;                // K: a ray samples level L up to K * nodeSize(L) away; resident by construction
  float sampleNear_m = 0;                // nearer than this a ray samples as if it were this far: a fast camera cannot refine its feet
  float bandBase_m = 0, bandTop_m = 0;   // altitudes that resident, non-zero data fills
  ResidencyStats stats;
};

class StreamState {
 public:
  StreamState(const DensitySource& source, const RootFrame& root, StreamSettings settings);
  ~StreamState();
  FrameEdits step(const FrameInput& input);
  // Checks every invariant of tree and pools; empty string if sound, else the first thing that is wrong.
  std::string validate() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

class Streamer {
 public:
  // `jitterSeed` != 0 sleeps a random while before each step (tests of determinism).
  Streamer(const DensitySource& source, const RootFrame& root, StreamSettings settings, std::uint32_t jitterSeed = 0);
  ~Streamer();  // stops the worker at once, whatever it is doing between steps
  void post(FrameInput input);                  // never blocks
  bool ready(std::uint64_t frame) const;        // are the edits of this frame there?
  FrameEdits take(std::uint64_t frame);         // waits for them
 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace welkin
