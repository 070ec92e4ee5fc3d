#pragma once
// What a sweep measures on: the poses, and one renderer for each tree that its settings ask for.
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "welkin/app/converge.h"
#include "welkin/gpu/context.h"
#include "welkin/render/renderer.h"

namespace welkin::app {

struct Poses {
  Scene scene;
  Size size;
  std::string name;
  std::vector<View> views;
  std::vector<double> times_s;  // of the scene, for each
  std::vector<std::vector<View>> before;  // of a path: the frames that lead to each pose, oldest first; else empty
};
Result<Poses> loadPoses(const ConvergeOptions& options);

class Trees {
 public:
  Trees(const Scene& scene, Size size, std::string gpu) : scene_(scene), size_(size), gpu_(std::move(gpu)) {}
  Result<void> openContext();
  Result<void> open(const measure::ConvergeSetting& setting);  // nothing to do if a setting before asked for the same tree
  Renderer& of(const measure::ConvergeSetting& setting) { return *trees_.at(key(setting)).renderer; }
  const FrameStats& settled(const measure::ConvergeSetting& setting) const { return trees_.at(key(setting)).settled; }  // the first time
  Result<void> settle(const View& view, double time_s, const std::function<bool(double)>& progress);  // all of them; progress returns false to stop
  void close() { trees_.clear(); }
  bool software() const { return context_->device().software; }
  gpu::Context& context() const { return *context_; }
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  using Key = std::tuple<std::uint64_t, int, int, double>;  // budget, depth, bits of a brick's numbers, fineness of its light
  static Key key(const measure::ConvergeSetting& s) { return {s.quality.budget_bytes, s.quality.depth, s.brickBits, s.light}; }
  struct Tree {
    std::unique_ptr<Renderer> renderer;
    FrameStats settled;
    bool fresh = true;
  };
  const Scene& scene_;
  Size size_;
  std::string gpu_;
  std::unique_ptr<gpu::Context> context_;  // outlives the trees
  std::map<Key, Tree> trees_;
  std::vector<std::string> notes_;
};

// The least tree of the first pose that is as fine as its pixels show, down to the thesis' depth.
Result<ThesisBudget> fillingBudget(const Poses& poses, Trees& trees, const measure::ConvergeSetting& base);

// What the options ask for. The thesis' preset looks for its budget and limits the tree to what pixels show (Poses::scene).
Result<std::vector<measure::ConvergeSetting>> chooseSettings(const ConvergeOptions& options, Poses& poses, Trees& trees);

}  // namespace welkin::app
