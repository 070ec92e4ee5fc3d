#pragma once
// The octree as the GPU stores it: maps and nodes in one buffer, brick textures, and what all passes know of it. It obeys the
// streamer's edits.
#include <array>
#include <bitset>
#include <vector>

#include "welkin/gpu/program.h"
#include "welkin/gpu/resources.h"
#include "welkin/octree/tree_data.h"
#include "welkin/physics/root_frame.h"
#include "welkin/shared/tree_block.glsl.h"
#include "welkin/stream/streamer.h"

namespace welkin {

// How a byte budget is divided among the tree's parts.
struct TreeLayout {
  std::uint32_t depth = 16, mapBase = 6;
  std::uint32_t textures = 1, layersPerTexture = 1;  // of 1024 bricks, 2 MiB
  std::uint32_t bricks = 0, groups = 0;
  int brickBits = 16;  // of each number of a brick, 8 or 16
  // What is left after `bytes`-sized other things; bricks == 0: not enough for a single layer.
  static TreeLayout fit(std::uint64_t bytes, std::uint32_t depth, int brickBits = 16);
  std::uint64_t bytes() const;
  static std::uint64_t leastBytes(std::uint32_t depth);
};

class ResidentTree {
 public:
  ResidentTree() = default;
  ResidentTree(ResidentTree&& o) noexcept;
  ~ResidentTree();
  static Result<ResidentTree> create(gpu::MemoryAccount& account, const TreeLayout& layout, const RootFrame& root);

  void store(const FrameEdits& edits);                       // node words and marks maps stale
  void updateMaps(glm::dvec3 camera_planet);                 // rebuilds stale map cells around the camera
  void updateBlock(const shared::TreeBlock& block);          // detail, band, sun … ; the layout's fields are filled in here
  void bind() const;                                         // nodes, maps, bricks, block
  void bindBrickImages(GLenum access) const;
  void bindChords() const;                                   // for writing
  TreeData readBack() const;                                 // waits for the GPU
  const TreeLayout& layout() const { return layout_; }
  gpu::Defines defines() const {
    gpu::Defines all{{"BRICK_TEXTURES", std::to_string(layout_.textures)}};
    if (layout_.brickBits == 8) all.insert(all.end(), {{"BRICK_FORMAT", "rg8"}, {"BRICK_STEPS", "255.0"}});
    return all;
  }
  std::uint32_t mapCellsUpdated() const { return mapCells_; }  // by the last updateMaps

 private:
  static constexpr int kBlocks = 16;  // blocks of 4^3 cells an axis in a map
  struct Map {
    glm::uvec3 origin{0};             // first cell of the window, a multiple of 4
    bool placed = false;
    std::bitset<kBlocks * kBlocks * kBlocks> stale;
  };
  std::size_t nodeOffset(std::uint32_t node) const;  // bytes into words_
  void markStale(const DirtyNode& node);
  void placeWindow(std::uint32_t level, glm::dvec3 camera_planet);

  TreeLayout layout_;
  RootFrame root_;
  gpu::Buffer words_, block_, mapJobs_, chords_;  // words: octree maps, then nodes; chords: of clouds at bricks' corners
  GLuint wordsView_ = 0, chordsView_ = 0;         // the same as buffer textures
  std::vector<gpu::Texture> bricks_;
  gpu::Program build_;
  std::array<Map, shared::kMaxDepth + 1> map_;
  std::uint32_t mapCells_ = 0;
  std::vector<glm::uvec4> jobs_;
};

}  // namespace welkin
