#include "render/tree/resident_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "welkin/shared/bindings.glsl.h"

namespace welkin {

using shared::kMapEdge;

namespace {
constexpr std::uint64_t kMapBytes = std::uint64_t{shared::kMapCells} * sizeof(shared::NodeWords);
constexpr std::uint64_t kGroupBytes = 64;
constexpr std::uint64_t kChordBytes = 32;  // of a brick: two numbers of 16 bits at eight corners
// Non-empty children of a split node are two to six of eight; three groups to four bricks leaves room for the sparse end.
constexpr std::uint32_t kGroupsPerLayer = shared::kBricksPerLayer * 3 / 4;
constexpr std::uint64_t kJobBytes = 16;

// A sample has two numbers.
std::uint64_t layerBytes(int brickBits) { return shared::kBricksPerLayer * (512 * 2 * std::uint64_t(brickBits / 8) + kChordBytes); }
std::uint32_t mapBaseOf(std::uint32_t depth) { return std::min(shared::kMapShift, depth); }
std::uint64_t fixedBytes(std::uint32_t depth) {
  const std::uint32_t levels = depth - mapBaseOf(depth) + 1;
  return levels * (kMapBytes + 4096 * kJobBytes) + sizeof(shared::TreeBlock);
}
}  // namespace

TreeLayout TreeLayout::fit(std::uint64_t bytes, std::uint32_t depth, int brickBits) {
  TreeLayout layout;
  layout.brickBits = brickBits;
  layout.depth = depth;
  layout.mapBase = mapBaseOf(depth);
  const std::uint64_t fixed = fixedBytes(depth);
  if (bytes < fixed) return layout;
  const auto layers = static_cast<std::uint32_t>(std::min<std::uint64_t>((bytes - fixed) / (layerBytes(brickBits) + kGroupsPerLayer * kGroupBytes),
                                                                         (shared::kBrickMask + 1) / shared::kBricksPerLayer));
  if (layers == 0) return layout;
  layout.textures = (layers + shared::kAtlasLayers - 1) / shared::kAtlasLayers;
  layout.layersPerTexture = layers / layout.textures;
  layout.bricks = layout.textures * layout.layersPerTexture * shared::kBricksPerLayer;
  layout.groups = layout.textures * layout.layersPerTexture * kGroupsPerLayer;
  return layout;
}

std::uint64_t TreeLayout::bytes() const {
  return fixedBytes(depth) + std::uint64_t{textures} * layersPerTexture * layerBytes(brickBits) + groups * kGroupBytes;
}

std::uint64_t TreeLayout::leastBytes(std::uint32_t depth) { return fixedBytes(depth) + layerBytes(16) + kGroupsPerLayer * kGroupBytes; }

ResidentTree::ResidentTree(ResidentTree&& o) noexcept
    : layout_(o.layout_), root_(o.root_), words_(std::move(o.words_)), block_(std::move(o.block_)), mapJobs_(std::move(o.mapJobs_)),
      chords_(std::move(o.chords_)), wordsView_(std::exchange(o.wordsView_, 0)), chordsView_(std::exchange(o.chordsView_, 0)), bricks_(std::move(o.bricks_)), build_(std::move(o.build_)), map_(o.map_),
      mapCells_(o.mapCells_), jobs_(std::move(o.jobs_)) {}

ResidentTree::~ResidentTree() {
  for (const GLuint view : {wordsView_, chordsView_})
    if (view) glDeleteTextures(1, &view);
}

std::size_t ResidentTree::nodeOffset(std::uint32_t node) const {
  return (shared::firstNode(layout_.mapBase, layout_.depth) + std::size_t{node}) * sizeof(shared::NodeWords);
}

Result<ResidentTree> ResidentTree::create(gpu::MemoryAccount& account, const TreeLayout& layout, const RootFrame& root) {
  ResidentTree tree;
  tree.layout_ = layout;
  tree.root_ = root;
  const std::uint32_t levels = layout.depth - layout.mapBase + 1;
  auto words = gpu::Buffer::create(account, "maps and nodes", levels * kMapBytes + layout.groups * kGroupBytes);
  if (!words) return words.error();
  auto block = gpu::Buffer::create(account, "tree block", sizeof(shared::TreeBlock));
  if (!block) return block.error();
  auto jobs = gpu::Buffer::create(account, "map jobs", levels * 4096 * kJobBytes);
  if (!jobs) return jobs.error();
  for (std::uint32_t i = 0; i < layout.textures; ++i) {
    auto bricks = gpu::Texture::create(account, "bricks", {.target = GL_TEXTURE_3D, .format = GLenum(layout.brickBits == 8 ? GL_RG8 : GL_RG16), .width = int(shared::kAtlasX * 8),
                                                           .height = int(shared::kAtlasY * 8), .depth = int(layout.layersPerTexture * 8)});
    if (!bricks) return bricks.error();
    tree.bricks_.push_back(std::move(*bricks));
  }
  auto chords = gpu::Buffer::create(account, "chords", std::uint64_t{layout.bricks} * kChordBytes);
  if (!chords) return chords.error();
  auto build = gpu::Program::compute("pass/maps/build.comp");
  if (!build) return build.error();
  tree.words_ = std::move(*words);
  glCreateTextures(GL_TEXTURE_BUFFER, 1, &tree.wordsView_);
  glTextureBuffer(tree.wordsView_, GL_RG32UI, tree.words_.id());
  tree.chords_ = std::move(*chords);
  tree.chords_.clear();
  glCreateTextures(GL_TEXTURE_BUFFER, 1, &tree.chordsView_);
  glTextureBuffer(tree.chordsView_, GL_RGBA32UI, tree.chords_.id());
  tree.block_ = std::move(*block);
  tree.mapJobs_ = std::move(*jobs);
  tree.build_ = std::move(*build);
  const shared::NodeWords root0{shared::packWord(shared::kZeroBrick, 0, 0), shared::kNoGroup};
  tree.words_.upload(tree.nodeOffset(0), std::as_bytes(std::span(&root0, 1)));
  return tree;
}

void ResidentTree::store(const FrameEdits& edits) {
  // Runs of neighbouring nodes go up in one call.
  std::vector<shared::NodeWords> run;
  for (std::size_t i = 0; i < edits.nodes.size();) {
    std::size_t end = i;
    run.clear();
    do run.push_back(edits.nodes[end].words);
    while (++end < edits.nodes.size() && edits.nodes[end].node == edits.nodes[end - 1].node + 1);
    words_.upload(nodeOffset(edits.nodes[i].node), run);
    i = end;
  }
  for (const DirtyNode& node : edits.dirty) markStale(node);
}

void ResidentTree::markStale(const DirtyNode& node) {
  for (std::uint32_t level = layout_.mapBase; level <= layout_.depth; ++level) {
    Map& map = map_[level];
    if (!map.placed) continue;
    const std::uint32_t shift = 32 - level;
    glm::ivec3 lo, hi;  // in blocks, clipped to the window
    bool outside = false;
    for (int a = 0; a < 3; ++a) {
      const std::uint64_t first = node.corner[a] >> shift;
      const std::uint64_t last = (std::uint64_t{node.corner[a]} + shared::levelMask(node.level)) >> shift;
      const std::uint64_t from = std::max<std::uint64_t>(first, map.origin[a]), to = std::min<std::uint64_t>(last, map.origin[a] + kMapEdge - 1);
      if (from > to) outside = true;
      lo[a] = int(from >> 2);
      hi[a] = int(to >> 2);
    }
    if (outside) continue;
    for (int z = lo.z; z <= hi.z; ++z)
      for (int y = lo.y; y <= hi.y; ++y)
        for (int x = lo.x; x <= hi.x; ++x) map.stale.set(std::size_t((x & 15) + 16 * ((y & 15) + 16 * (z & 15))));
  }
}

void ResidentTree::placeWindow(std::uint32_t level, glm::dvec3 camera_planet) {
  Map& map = map_[level];
  const double cell_m = root_.nodeSize_m(level);
  const double cells = std::ldexp(1.0, int(level));
  glm::uvec3 origin{0};
  for (int a = 0; a < 3; ++a) {
    // Rounded to blocks of four: the camera stays at least kMapReach cells from the window's faces.
    const double centre = (camera_planet[a] + root_.half_m) / cell_m;
    const double first = 4.0 * std::round((centre - kMapEdge / 2.0) / 4.0);
    origin[a] = static_cast<std::uint32_t>(std::clamp(first, 0.0, std::max(cells - kMapEdge, 0.0)));
  }
  if (map.placed && origin == map.origin) return;
  for (int z = 0; z < kBlocks; ++z)
    for (int y = 0; y < kBlocks; ++y)
      for (int x = 0; x < kBlocks; ++x) {
        const glm::uvec3 cell = origin + glm::uvec3(x, y, z) * 4u;
        bool old = map.placed;
        for (int a = 0; a < 3; ++a) old = old && cell[a] >= map.origin[a] && cell[a] < map.origin[a] + kMapEdge;
        const glm::uvec3 block = (cell >> 2u) & 15u;
        if (!old) map.stale.set(block.x + 16 * (block.y + 16 * block.z));
      }
  map.origin = origin;
  map.placed = true;
}

void ResidentTree::updateMaps(glm::dvec3 camera_planet) {
  jobs_.clear();
  for (std::uint32_t level = layout_.mapBase; level <= layout_.depth; ++level) {
    placeWindow(level, camera_planet);
    Map& map = map_[level];
    if (map.stale.none()) continue;
    const std::uint32_t cells = level >= 32 ? 0xFFFFFFFFu : (1u << level);
    const glm::uvec3 firstBlock = map.origin >> 2u;
    for (std::uint32_t i = 0; i < map.stale.size(); ++i) {
      if (!map.stale[i]) continue;
      // the block of the window with these low bits
      glm::uvec3 block{i & 15u, (i >> 4) & 15u, i >> 8};
      block = firstBlock + ((block - firstBlock) & 15u);
      const glm::uvec3 cell = block * 4u;
      if (cell.x >= cells || cell.y >= cells || cell.z >= cells) continue;
      jobs_.emplace_back(cell, level);
    }
    map.stale.reset();
  }
  mapCells_ = static_cast<std::uint32_t>(jobs_.size() * 64);
  if (jobs_.empty()) return;
  mapJobs_.upload(0, jobs_);
  mapJobs_.bind(GL_SHADER_STORAGE_BUFFER, WK_MAP_JOBS_BINDING);
  words_.bind(GL_SHADER_STORAGE_BUFFER, WK_NODES_BINDING);
  block_.bind(GL_UNIFORM_BUFFER, WK_TREE_BINDING);
  constexpr std::size_t kMostGroups = 65535;
  for (std::size_t first = 0; first < jobs_.size(); first += kMostGroups) {
    build_.set("u_firstJob", static_cast<unsigned>(first));
    build_.dispatch(static_cast<unsigned>(std::min(kMostGroups, jobs_.size() - first)));
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void ResidentTree::updateBlock(const shared::TreeBlock& values) {
  shared::TreeBlock block = values;
  block.half_m = root_.half_m;
  block.stepsPerMetre = root_.stepsPerMetre();
  block.stepLength_m = static_cast<float>(root_.step_m());
  block.rootSize_m = static_cast<float>(2 * root_.half_m);
  block.planetRadius_m = static_cast<float>(root_.planetRadius_m);
  block.depth = layout_.depth;
  block.mapBase = layout_.mapBase;
  block.firstNode = shared::firstNode(layout_.mapBase, layout_.depth);
  block.atlasDepthInverse = 1.0f / static_cast<float>(layout_.layersPerTexture * 8);
  block.bricksPerTexture = layout_.layersPerTexture * shared::kBricksPerLayer;
  block_.upload(0, std::as_bytes(std::span(&block, 1)));
}

void ResidentTree::bind() const {
  block_.bind(GL_UNIFORM_BUFFER, WK_TREE_BINDING);
  glBindTextureUnit(WK_TREE_UNIT, wordsView_);
  glBindTextureUnit(WK_CHORDS_UNIT, chordsView_);
  for (std::size_t i = 0; i < bricks_.size(); ++i) bricks_[i].bind(static_cast<GLuint>(WK_BRICK_UNIT + i));
}

void ResidentTree::bindChords() const { chords_.bind(GL_SHADER_STORAGE_BUFFER, WK_CHORDS_BINDING); }

void ResidentTree::bindBrickImages(GLenum access) const {
  for (std::size_t i = 0; i < bricks_.size(); ++i) bricks_[i].bindImage(static_cast<GLuint>(i), access);
}

}  // namespace welkin
