#include "welkin/app/restore.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "welkin/core/files.h"
#include "welkin/physics/scene_io.h"

namespace welkin::app {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kMostBytes = 1 << 30;  // a picture or path of the greatest size; the readers have limits of their own

// Is it a path rather than a scene? One key tells; a whole reading with its messages follows.
bool hasFrames(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const auto outermost = [](int depth, nlohmann::json::parse_event_t, nlohmann::json&) { return depth <= 1; };
  const auto root = nlohmann::json::parse(in, outermost, false);
  return root.is_object() && root.contains("frames");
}

Result<Restored> restorePath(const fs::path& file) {
  auto path = loadPath(file);
  if (!path) return path.error();
  auto scene = loadScene(path->scene);
  if (!scene) return Error{fmt::format("{}: /scene: {}", file.string(), scene.error().message)};
  if (auto above = checkPath(*path, scene->planet); !above) return above.error();
  Restored out{RestoredKind::Path, {}, {}, {}};
  out.start.scene = std::move(*scene);
  out.start.view = path->frames.front().view;
  out.start.size = {path->width, path->height};
  out.start.time_s = path->frames.front().time_s;
  out.path = std::move(*path);
  return out;
}

}  // namespace

Result<Restored> restoreFrom(const fs::path& file) {
  std::error_code ec;
  const auto type = fs::status(file, ec).type();
  if (type == fs::file_type::directory) return Error{fmt::format("{}: expected a file, found a folder", oneLine(file.string(), 1000))};
  if (type == fs::file_type::not_found) return Error{fmt::format("{}: there is no such file", oneLine(file.string(), 1000))};
  if (type != fs::file_type::regular) return Error{fmt::format("{}: expected a plain file", oneLine(file.string(), 1000))};
  std::ifstream in(file, std::ios::binary);
  if (!in) return Error{fmt::format("{}: cannot be read", oneLine(file.string(), 1000))};
  std::string head(256, '\0');
  in.read(head.data(), std::streamsize(head.size()));
  head.resize(std::size_t(in.gcount()));

  const bool picture = kindOfBytes(head) != PictureKind::None;
  const auto first = head.find_first_not_of(" \t\r\n");
  if (!picture && (first == std::string::npos || head[first] != '{')) {
    return Error{fmt::format("{}: expected a picture (PNG, EXR) of this program, a scene, a path or a result of a flight (JSON)",
                             oneLine(file.string(), 1000))};
  }
  if (fs::file_size(file, ec) > kMostBytes)
    return Error{fmt::format("{}: expected at most {} bytes", oneLine(file.string(), 1000), kMostBytes)};
  if (!picture && isFlightResult(file)) {
    auto result = loadFlightResult(file);
    if (!result) return result.error();
    return Restored{RestoredKind::FlightResult, {}, {}, std::move(*result)};
  }
  if (!picture && hasFrames(file)) return restorePath(file);
  auto start = loadStart(file, "");
  if (!start) return start.error();
  return Restored{picture ? RestoredKind::Picture : RestoredKind::Scene, std::move(*start), {}, {}};
}

}  // namespace welkin::app
