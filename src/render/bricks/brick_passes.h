#pragma once
// Generation and lighting of queued bricks. Results of generation are read back two frames later, so no frame waits for the GPU.
#include <deque>
#include <vector>

#include "render/tree/resident_tree.h"
#include "welkin/clouds/density_source.h"
#include "welkin/render/frame_plan.h"

namespace welkin {

class BrickPasses {
 public:
  // Without a sun the light pass is not compiled, and light() may not be called.
  static Result<BrickPasses> create(gpu::MemoryAccount& account, const DensitySource& source, const ResidentTree& tree, const FramePlan& plan, double light);

  void generate(const ResidentTree& tree, const std::vector<BrickJob>& jobs, std::uint64_t frame);
  void light(const ResidentTree& tree, const std::vector<BrickJob>& jobs);
  // Results of all generations of `frame` and earlier, in the order of their jobs.
  std::vector<BrickResult> results(std::uint64_t upToFrame);

  static constexpr std::uint32_t kBatch = 4096;  // jobs of one dispatch; generate() and light() take any number
  static std::uint64_t bytes(const DensitySource& source);

 private:
  struct Pending {
    std::uint64_t frame;
    std::vector<BrickJob> jobs;
    std::vector<shared::GpuBrickResult> results;
    int slot = -1;          // where in the result buffer they still lie; -1: already in `results`
  };
  void collect(Pending& pending);
  void upload(const BrickJob* jobs, std::size_t count, std::size_t slot);

  gpu::Buffer jobs_, results_, params_;
  gpu::Texture cover_;
  gpu::Program generate_, light_;
  std::deque<Pending> pending_;
  std::uint32_t nextSlot_ = 0;
  std::vector<shared::GpuBrickJob> staging_;
};

}  // namespace welkin
