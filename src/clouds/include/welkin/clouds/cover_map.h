#pragma once
// Where cloud is, over the whole planet: cover 0..1 on six cube faces with border texels and mips (shared/cover.glsl.h), and the
// least and greatest cover of any box.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "welkin/core/result.h"
#include "welkin/shared/cloud_source.glsl.h"

namespace welkin {

// A picture of the globe: equirectangular, row 0 at the north pole, column 0 at 180 degrees west.
struct CoverPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> cover;  // 255 = full
  // 0..1: bilinear, or the mean of four such samples spread over a square of this width.
  float at(glm::dvec3 direction_planet, double width_rad = 0) const;

 private:
  float bilinear(float x, float y) const;  // in pixels
};

// Reads a PNG: cover is its alpha, or its grey value where it has no alpha. Error: one line that names the file.
Result<CoverPicture> loadCoverPicture(const std::filesystem::path& file);

// Cover of made-up weather in a direction, 0..1: trade cumulus, storm tracks, dry subtropics, a rain belt, cyclones.
class ProceduralWeather {
 public:
  explicit ProceduralWeather(std::uint32_t seed);
  float at(glm::dvec3 direction_planet) const;

 private:
  struct Cyclone {
    glm::dvec3 centre;
    double radius_rad, turn, strength, phase;
  };
  std::uint32_t seed_;
  std::vector<Cyclone> cyclones_;
};

struct CoverRange {
  float lo = 0, hi = 0;
};

class CoverMap {
 public:
  // Cover at the centres of edge^2 texels a face; `edge` a power of two. `cover` is called from several threads.
  static CoverMap bake(std::uint32_t edge, const std::function<float(glm::dvec3)>& cover);

  const std::vector<std::uint32_t>& words() const { return words_; }
  void describe(shared::CloudHeader& header) const;  // mips, edges, offsets, mip by level (footprint_m and radius must be set)
  // Range of the cover that coverAt() may give in a box of fixed-point steps [low, low + size - 1], at mips 0..greatestMip.
  CoverRange range(glm::uvec3 low, std::uint64_t size, std::uint32_t greatestMip) const;

 private:
  std::uint8_t texel(std::uint32_t mip, std::uint32_t face, std::uint32_t x, std::uint32_t y) const;  // border included
  void fillBorders(std::uint32_t mip);
  void buildPyramid();
  CoverRange faceRange(std::uint32_t face, glm::dvec4 rect, std::uint32_t greatestMip) const;
  CoverRange texels(std::uint32_t face, int x0, int y0, int x1, int y1) const;

  std::uint32_t mips_ = 0;
  std::uint32_t edge_[shared::kCoverMips] = {}, offset_[shared::kCoverMips] = {};
  std::vector<std::uint32_t> words_;
  struct Cell {
    std::uint8_t lo, hi;
  };
  std::vector<std::vector<Cell>> pyramid_;  // [k]: blocks of 2^(k+1) texels of mip 0's interior, 6 faces
};

// Direction of a place on a face, not normalised; u and v 0..1.
glm::dvec3 coverDirection(std::uint32_t face, double u, double v);

}  // namespace welkin
