#include "welkin/app/video.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

extern char** environ;

namespace welkin::app {
namespace fs = std::filesystem;

bool haveFfmpeg() {
  const char* path = std::getenv("PATH");
  std::string folders = path ? path : "";
  for (std::size_t at = 0; at < folders.size();) {
    const auto end = std::min(folders.find(':', at), folders.size());
    const fs::path program = fs::path(folders.substr(at, end - at)) / "ffmpeg";
    if (::access(program.c_str(), X_OK) == 0) return true;
    at = end + 1;
  }
  return false;
}

Result<std::unique_ptr<VideoWriter>> VideoWriter::open(const fs::path& file, int width, int height, double framesPerSecond) {
  if (!haveFfmpeg()) return Error{fmt::format("{}: a video needs the program ffmpeg, which is not on the PATH", file.string())};
  std::unique_ptr<VideoWriter> self(new VideoWriter(file));
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return Error{fmt::format("{}: no pipe to ffmpeg", file.string())};
  // A name that starts with '-' would be taken for an option.
  const std::string output = "file:" + self->pending_.temporary().string();
  std::vector<std::string> arguments{"ffmpeg",
                                     "-nostdin",
                                     "-loglevel",
                                     "error",
                                     "-y",
                                     "-f",
                                     "rawvideo",
                                     "-pix_fmt",
                                     "rgba",
                                     "-s",
                                     fmt::format("{}x{}", width, height),
                                     "-r",
                                     fmt::format("{}", framesPerSecond),
                                     "-i",
                                     "pipe:0",
                                     "-vf",
                                     "crop=trunc(iw/2)*2:trunc(ih/2)*2",
                                     "-c:v",
                                     "libx264",
                                     "-crf",
                                     "18",
                                     "-preset",
                                     "veryfast",
                                     "-pix_fmt",
                                     "yuv420p",
                                     "-f",
                                     "mp4",
                                     output};
  std::vector<char*> argv;
  for (auto& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], 0);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // A group of its own: Ctrl-C ends the flight, and ffmpeg then ends because its input does.
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGDEF);
  posix_spawnattr_setpgroup(&attributes, 0);
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGPIPE);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  pid_t child = -1;
  const int failed = ::posix_spawnp(&child, "ffmpeg", &actions, &attributes, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  ::close(ends[0]);
  if (failed != 0) {
    ::close(ends[1]);
    return Error{fmt::format("{}: ffmpeg cannot be started", file.string())};
  }
  self->pipe_ = ends[1];
  self->child_ = child;
  return self;
}

VideoWriter::~VideoWriter() {
  if (pipe_ >= 0) ::close(pipe_);
  if (child_ > 0) ::waitpid(child_, nullptr, 0);
}

Error VideoWriter::failure() { return Error{fmt::format("{}: ffmpeg ended before the video was whole", file_.string())}; }

Result<void> VideoWriter::add(const Image8& frame) {
  const std::uint8_t* at = frame.rgba.data();
  std::size_t left = frame.rgba.size();
  while (left > 0) {
    const ssize_t n = ::write(pipe_, at, left);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return failure();
    at += n;
    left -= std::size_t(n);
  }
  return {};
}

Result<void> VideoWriter::finish() {
  ::close(pipe_);
  pipe_ = -1;
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return failure();
  return pending_.commit();
}

}  // namespace welkin::app
