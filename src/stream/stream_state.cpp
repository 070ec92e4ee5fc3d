#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "job_queue.h"
#include "motion.h"
#include "relight.h"
#include "welkin/octree/selection.h"
#include "welkin/octree/validator.h"
#include "welkin/stream/streamer.h"

namespace welkin {
namespace {

// While there is only the root, K would be 0 for a camera inside it. This keeps its logarithm finite, and asks for the root alone
// from a centimetre on. From nothing it does not glide up but starts where levels begin to show.
constexpr double kLeastDetail = 1e-9, kGlideFrom = 1.0 / 64;
constexpr double kGlideUp = 1.005, kGlideDown = 0.95;
// A level is sampled from 3/8 of its range on: its child's range is half of it, and the last quarter of that blends with this level.
constexpr double kSampledFrom = 0.375;
constexpr std::uint32_t kMaxNewGroups = 1024;  // a step: bounds of their children cost most of it
constexpr std::uint32_t kAtLeisure = 256;      // bricks a step that are lit again while nothing else is to do: 20 ms of two cores

}  // namespace

struct StreamState::Impl {
  Impl(const DensitySource& densitySource, const RootFrame& rootFrame, const StreamSettings& streamSettings)
      : source(densitySource),
        root(rootFrame),
        settings(streamSettings),
        tree(streamSettings.groupCapacity, streamSettings.brickCapacity),
        jobs(tree),
        relight(streamSettings.brickCapacity) {
    if (settings.depth < 1 || settings.depth > shared::kMaxDepth) throw std::invalid_argument("octree: the depth must be 1 to 24");
    selectionSettings = {settings.depth,       settings.brickCapacity, settings.groupCapacity,
                         settings.detailLimit, kMaxNewGroups,          source.emptyFrom()};
    bounds = [this](glm::uvec3 corner, std::uint32_t level) {
      const Bounds b = source.bounds(corner, level);
      return SourceBounds{b.lo, b.hi};
    };
  }

  FrameEdits step(const FrameInput& input);
  SelectionView lookFrom() const;
  void plant(FrameEdits& edits);
  void receive(const std::vector<BrickResult>& results);
  void publishIfComplete(GroupIndex group);
  bool reselect();
  void followDetail(bool snap);
  void findSampled(NodeIndex node, const NodeView& view, const NodeView::Seen& above);
  void findBand(NodeIndex node, const NodeView& view, const NodeView::Seen& above);
  void writeOut(FrameEdits& edits, const FrameInput& input, bool idle);
  ResidencyStats stats(bool settled) const;

  const DensitySource& source;
  const RootFrame root;
  const StreamSettings settings;
  SelectionSettings selectionSettings;
  BoundsFunction bounds;
  Tree tree;
  JobQueue jobs;
  TreeChanges changes;
  Selection selection;
  Motion motion;
  bool planted = false, selectionStale = true, following = true;
  double detail = 0;        // K that is sampled
  double targetDetail = 0;  // where it glides to
  double drawnDetail = 0;   // K at which rays sample: that, or what a pixel asks for
  float bandBase_m = 0, bandTop_m = 0;
  Relight relight;
  std::vector<BrickIndex> sampled;  // bricks that a visible ray may read, while their light is not exact
  std::uint64_t steps = 0;
};

SelectionView StreamState::Impl::lookFrom() const {
  SelectionView view = motion.view();
  view.cloudBase_m = source.base_m();
  view.cloudTop_m = source.top_m();
  const double altitude_m = glm::length(view.position_m) - root.planetRadius_m;
  if (settings.deck && altitude_m < kDeckSeenFrom_m) view.deckTop_m = settings.deck->top_m, view.deckFloor_m = settings.deck->floor_m;
  return view;
}

// The root and its seven unused siblings: the GPU's buffer starts as anything.
void StreamState::Impl::plant(FrameEdits& edits) {
  planted = true;
  tree.plantRoot(bounds(glm::uvec3(0), 0));
  for (std::uint32_t node = 0; node < 8; ++node)
    edits.nodes.push_back({node, {shared::packWord(shared::kZeroBrick, 0, 0), shared::kNoGroup}});
  jobs.add(kRootGroup);
  publishIfComplete(kRootGroup);
}

void StreamState::Impl::publishIfComplete(GroupIndex group) {
  const Group& g = tree.group(group);
  if (g.pending == 0 && !g.published) tree.publish(group, changes);
}

void StreamState::Impl::receive(const std::vector<BrickResult>& results) {
  for (const BrickResult& result : results) {
    const auto node = jobs.match(result.brick);
    if (!node) continue;
    tree.setGenerated(*node, {result.min, result.max, result.minAltitude_m, result.maxAltitude_m});
    publishIfComplete(groupOf(*node));
  }
}

// Brings the tree to what selection wants. True if it was so already.
bool StreamState::Impl::reselect() {
  const SelectionView view = lookFrom();
  select(tree, root, view, selectionSettings, bounds, selection);
  bool same = selection.complete && selection.added.empty();
  // Merges first: their places are taken again. Of nested ones only the topmost is told.
  for (std::uint32_t g = 1; g < selection.keep.size(); ++g) {
    if (!tree.isLive({g})) continue;
    if (selection.keep[g]) {
      tree.group(GroupIndex{g}).key = selection.key[g];
      continue;
    }
    GroupIndex top{g};
    for (GroupIndex above = groupOf(tree.group(top).parent); !selection.keep[above.value]; above = groupOf(tree.group(top).parent))
      top = above;
    tree.merge(tree.group(top).parent, changes);
    same = false;
  }
  std::vector<GroupIndex> made;
  made.reserve(selection.added.size());
  for (const NewGroup& added : selection.added) {
    const NodeIndex parent = added.parent.valid() ? added.parent : nodeOf(made[added.parentAdded], added.octant);
    const GroupIndex group = tree.split(parent, added.bounds);
    tree.group(group).key = added.key;
    made.push_back(group);
    jobs.add(group);
    publishIfComplete(group);
  }
  targetDetail = std::max(std::min(selection.detail / kHysteresis, selection.residentDetail), kLeastDetail);
  return same;
}

void StreamState::Impl::followDetail(bool snap) {
  if (snap) following = true;
  if (following) {
    detail = targetDetail;
  } else if (targetDetail > detail) {
    detail = std::min(targetDetail, std::max(detail, kGlideFrom) * kGlideUp);
  } else {
    detail = std::max(targetDetail, detail * kGlideDown);
  }
}

// Joins the altitudes of all bricks that a visible ray may sample: leaves, and those far enough that their level is sampled.
void StreamState::Impl::findBand(NodeIndex node, const NodeView& view, const NodeView::Seen& above) {
  const Node& n = tree.node(node);
  if (!(n.joined.max > 0) || (n.joined.base_m >= bandBase_m && n.joined.top_m <= bandTop_m)) return;
  const NodeAddress at = tree.address(node);
  const NodeView::Seen seen = view.look(at, above);
  if (!seen.visible()) return;
  const bool open = n.children.valid() && tree.group(n.children).reachable;
  if (n.own.max > 0 && (!open || view.farDistance_m(at) >= kSampledFrom * drawnDetail * root.nodeSize_m(at.level))) {
    bandBase_m = std::min(bandBase_m, n.own.base_m);
    bandTop_m = std::max(bandTop_m, n.own.top_m);
  }
  if (!open) return;
  for (std::uint32_t octant = 0; octant < 8; ++octant) findBand(nodeOf(n.children, octant), view, seen);
}

// A level is sampled up to K times its size away, and from 3/8 of that on, or as far as there is no finer one.
void StreamState::Impl::findSampled(NodeIndex node, const NodeView& view, const NodeView::Seen& above) {
  const Node& n = tree.node(node);
  if (!(n.joined.max > 0)) return;
  const NodeAddress at = tree.address(node);
  const NodeView::Seen seen = view.look(at, above);
  const double reach_m = drawnDetail * root.nodeSize_m(at.level);
  if (!seen.visible() || (seen.drawn_m > reach_m && at.level > 0)) return;
  const bool open = n.children.valid() && tree.group(n.children).reachable;
  if (n.own.max > 0 && !n.pending && (!open || view.farDistance_m(at) >= kSampledFrom * reach_m)) sampled.push_back(n.brick);
  if (!open) return;
  for (std::uint32_t octant = 0; octant < 8; ++octant) findSampled(nodeOf(n.children, octant), view, seen);
}

void StreamState::Impl::writeOut(FrameEdits& edits, const FrameInput& input, bool idle) {
  auto& touched = changes.touched;
  std::sort(touched.begin(), touched.end());
  for (const NodeIndex node : touched) {
    if (tree.takeTouched(node)) edits.nodes.push_back({node.value, tree.words(node)});
  }
  const auto reachable = [&](NodeIndex node) { return tree.isLive(groupOf(node)) && tree.group(groupOf(node)).reachable; };
  // A dirty node covers the dirty ones below it.
  std::vector<NodeIndex> dirty;
  for (const NodeIndex node : changes.dirty) {
    if (reachable(node)) dirty.push_back(node);
  }
  std::sort(dirty.begin(), dirty.end());
  dirty.erase(std::unique(dirty.begin(), dirty.end()), dirty.end());
  for (const NodeIndex node : dirty) {
    bool covered = false;
    for (NodeIndex above = tree.parentOf(node); above.valid() && !covered; above = tree.parentOf(above)) {
      covered = std::binary_search(dirty.begin(), dirty.end(), above);
    }
    const NodeAddress at = tree.address(node);
    if (!covered) edits.dirty.push_back({at.corner, at.level});
  }
  std::erase_if(changes.shown,
                [&](NodeIndex node) { return !reachable(node) || tree.node(node).brick.isZero() || tree.node(node).pending; });
  for (const NodeIndex node : changes.shown) {
    const NodeAddress at = tree.address(node);
    edits.light.push_back({tree.node(node).brick.value, at.corner, at.level});
  }
  relight.sun(input.toSun, steps);
  relight.lit(tree, changes.shown, steps, !input.snap);  // a cut lights all at its end: each once
  relight.take(tree, steps, edits.light);
  // With nothing else to do: for a sun that moved, or a cut, as much as is generated otherwise; else at leisure. While bricks come: half of what
  // is generated, for a sun that moved, and half of what is lit anyway. Of that nothing on the way: old light is that of another tree, seen
  // from elsewhere, and making it anew would be seen (pops of 11 instead of 3 of 255 in the recorded descent).
  const std::uint32_t more = motion.changed() ? 0 : std::uint32_t(edits.light.size()) / 2;
  const std::uint32_t leisure = relight.sunMoved() || input.snap ? input.maxBricks : std::min(input.maxBricks, kAtLeisure);
  std::uint32_t most = idle ? leisure : std::max(more, relight.sunMoved() ? input.maxBricks / 2 : 0);
  sampled.clear();
  if (!relight.exact() && tree.group(kRootGroup).reachable) findSampled(kRootNode, NodeView(root, lookFrom()), {});
  if (relight.sunMoved()) most -= relight.follow(tree, sampled, steps, most, edits.light);
  relight.sweep(tree, steps, most, edits.light);
  edits.oldestSun = relight.oldestSun(sampled);
  changes.clear();
}

ResidencyStats StreamState::Impl::stats(bool settled) const {
  ResidencyStats s;
  s.nodes = tree.nodeCount();
  s.groups = tree.groupPool().used();
  s.bricks = tree.brickPool().used();
  s.brickCapacity = settings.brickCapacity;
  s.emptyNodes = s.nodes - (s.bricks - 1);
  s.pendingBricks = tree.pendingBricks();
  for (std::uint32_t level = 0; level <= shared::kMaxDepth; ++level) s.bricksByLevel[level] = tree.bricksAtLevel(level);
  s.cpuBytes = tree.bytes() + jobs.bytes() + selection.bytes() + relight.bytes();
  s.selectedDetail = selection.detail;
  s.settled = settled;
  return s;
}

FrameEdits StreamState::Impl::step(const FrameInput& input) {
  FrameEdits edits;
  edits.frame = input.frame;
  if (!planted) plant(edits);
  receive(input.results);
  motion.advance(input.camera, input.snap);
  const double limit = input.detailLimit > 0
                           ? std::min(input.detailLimit, settings.detailLimit > 0 ? settings.detailLimit : kGreatestDetail)
                           : settings.detailLimit;
  if (limit != selectionSettings.detailLimit) selectionSettings.detailLimit = limit, selectionStale = true;
  const bool work = selectionStale || motion.changed() || !input.results.empty();
  if (work) selectionStale = !reselect();
  edits.generate = jobs.take(input.maxBricks);
  const double drawnBefore = drawnDetail;
  followDetail(input.snap);
  drawnDetail = std::min(detail, input.camera.pixelDetail);
  const bool idle = !selectionStale && tree.pendingBricks() == 0;
  if (idle) following = false;
  if (work || drawnDetail != drawnBefore) {
    const SelectionView view = lookFrom();
    bandBase_m = std::numeric_limits<float>::infinity();
    bandTop_m = -bandBase_m;
    if (tree.group(kRootGroup).reachable) findBand(kRootNode, NodeView(root, view), {});
    if (bandBase_m > bandTop_m) bandBase_m = bandTop_m = 0;
  }
  ++steps;
  writeOut(edits, input, idle);
  edits.sampleDetail = static_cast<float>(detail);
  edits.sampleNear_m = static_cast<float>(motion.view().near_m);
  edits.bandBase_m = bandBase_m;
  edits.bandTop_m = bandTop_m;
  edits.stats = stats(idle && relight.done() && relight.exact() && detail == targetDetail && motion.view().near_m == 0);
  return edits;
}

StreamState::StreamState(const DensitySource& source, const RootFrame& root, StreamSettings settings)
    : impl_(std::make_unique<Impl>(source, root, settings)) {}
StreamState::~StreamState() = default;
FrameEdits StreamState::step(const FrameInput& input) { return impl_->step(input); }
std::string StreamState::validate() const {
  if (impl_->tree.brickPool().capacity() < impl_->tree.brickPool().used()) return "more bricks than the capacity";
  return validateTree(impl_->tree, impl_->source.maxExtinction());
}

}  // namespace welkin
