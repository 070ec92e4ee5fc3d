#pragma once
// Where cloud is. Render code never knows which source is active: it asks for the GLSL that evaluates it.
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "welkin/core/result.h"
#include "welkin/physics/root_frame.h"
#include "welkin/physics/scene.h"
#include "welkin/shared/octree.glsl.h"

namespace welkin {

// Extinction in 1/m over a box, conservative: lo <= every value that a brick of the box may store <= hi.
struct Bounds {
  float lo = 0, hi = 0;
  bool empty() const { return hi <= 0; }
  bool constant() const { return lo == hi; }
};

// Six faces of size^2 cover values 0..1, face order +X -X +Y -Y +Z -Z (clouds/cover_map.h builds it from a picture).
struct CoverFaces {
  int size = 0;
  std::vector<std::uint16_t> texels;  // 65535 = full cover; [face][y][x]
};

class DensitySource {
 public:
  virtual ~DensitySource() = default;
  // Bounds over the node (corner, level), valid for every level's band-limited samples of positions inside it.
  virtual Bounds bounds(glm::uvec3 corner, std::uint32_t level) const = 0;
  // Extinction in 1/m at a fixed-point position, band-limited to the voxel of `level` (node size / 7). Twin of the GLSL.
  virtual float density(glm::uvec3 p, std::uint32_t level) const = 0;
  // Greatest extinction in 1/m that density() can return: bricks store density / maxExtinction in 16 bits.
  virtual float maxExtinction() const = 0;
  // From this level on the samples of a brick are so dense that, if all are zero, so is all below it but for a negligible rest.
  virtual std::uint32_t emptyFrom() const { return shared::kMaxDepth + 1; }
  // Altitudes between which cloud can be, in metres, at infinite resolution.
  virtual double base_m() const = 0;
  virtual double top_m() const = 0;
  // GLSL: path below shaders/ of a file that defines `void prepareSource(uvec3 corner, uint level, uint index)`, called once by all 64
  // invocations of a brick, and `float[8] sourceColumn(uvec3 corner, uint level, uvec2 xy)`, the extinctions in 1/m of the brick's samples
  // (x, y, 0..7). It reads `sourceParams` (std430 buffer of 32-bit words, declared by the file at binding WK_SOURCE_PARAMS_BINDING) and, if
  // cover() is given, `u_cover` (sampler2DArray, R16, 6 layers, texelFetch only, WK_COVER_UNIT).
  virtual std::string shader() const = 0;
  virtual std::vector<std::uint32_t> shaderParams() const = 0;
  virtual const CoverFaces* cover() const { return nullptr; }
  // What went on at load that a user should know ("cover map not found: procedural weather"), or empty.
  virtual std::string note() const { return {}; }
};

Result<std::unique_ptr<DensitySource>> makeDensitySource(const Scene& scene, const RootFrame& root);

}  // namespace welkin
