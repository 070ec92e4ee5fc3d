#pragma once
// Frames into a video, by the program ffmpeg.
#include <fmt/format.h>  // before shared headers, whose macro F its templates would meet

#include <filesystem>
#include <memory>

#include "welkin/core/files.h"
#include "welkin/core/result.h"
#include "welkin/render/renderer.h"

namespace welkin::app {

class VideoWriter {
 public:
  // Starts ffmpeg (H.264, yuv420p; odd edges lose a pixel). Error: ffmpeg is not there. `framesPerSecond` from 1e-3 to 1000.
  static Result<std::unique_ptr<VideoWriter>> open(const std::filesystem::path& file, int width, int height, double framesPerSecond);
  ~VideoWriter();  // without finish(): no file stays
  Result<void> add(const Image8& frame);
  Result<void> finish();

 private:
  explicit VideoWriter(const std::filesystem::path& file) : file_(file), pending_(file) {}
  Error failure();
  std::filesystem::path file_;
  PendingFile pending_;
  int pipe_ = -1;
  int child_ = -1;
};

bool haveFfmpeg();

}  // namespace welkin::app
