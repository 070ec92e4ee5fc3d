#pragma once
// Whole pictures of what rays through the clouds bring.
#include <functional>
#include <vector>

#include "welkin/reference/cloud_march.h"

namespace welkin::reference {

struct PictureSettings {
  int width = 0, height = 0;
  std::vector<std::uint32_t> pixels;  // row * width + column, which to compute; empty: all
  double tolerance = 1e-5;            // of marchClouds
  unsigned threads = 0;               // 0: one a core; the numbers do not depend on it
};

// Every n-th pixel of a grid of n x n with its own offset in each row of cells, so that neither rows nor columns are left out.
std::vector<std::uint32_t> somePixels(int width, int height, int n);

struct CloudPicture {
  std::vector<std::uint32_t> pixels;  // which
  std::vector<CloudTruth> clouds;     // of each
  double worstError = 0;              // of all pixels
  bool converged = true;
  bool kept = false;  // it was on disk
};

// Which pixels are computed, with what their rays bring.
CloudPicture pictureOf(const PictureSettings& settings, std::vector<CloudTruth> clouds);

// `progress` gets 0..1 and may return false to stop: then the picture is empty.
CloudPicture marchPicture(const CloudField& field, const shared::CameraBlock& camera, const PictureSettings& settings,
                          const std::function<bool(double)>& progress = {});

// The same, but not done again: kept on disk (core/cache.h) under a hash of field, camera, pixels and tolerance.
CloudPicture keptPicture(const CloudField& field, const shared::CameraBlock& camera, const PictureSettings& settings,
                         const std::function<bool(double)>& progress = {});

// For Renderer::drawWith: all pixels, rows from the top; those that were not computed show no cloud.
std::vector<shared::CloudWeights> weightsOf(const CloudPicture& picture, int width, int height);

}  // namespace welkin::reference
