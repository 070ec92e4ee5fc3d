#include "welkin/physics/path_io.h"

#include <fmt/format.h>

#include "scene_io_json.h"
#include "welkin/core/files.h"
#include "welkin/physics/scene_time.h"

namespace welkin {
namespace fs = std::filesystem;
using detail::InputError;
using detail::JsonPlace;

namespace {

constexpr std::uint64_t kMaxPathBytes = 512 << 20;  // kMaxPathFrames at about 300 bytes a frame

FlightPath readPath(const JsonPlace& p, const fs::path& baseFolder) {
  p.object({"name", "scene", "size", "time_step_s", "warm_up", "frames"});
  FlightPath out;
  if (p.has("name")) out.name = p.at("name").text(0, 200);
  out.scene = p.at("scene").text();
  if (!baseFolder.empty() && out.scene.is_relative()) out.scene = fs::absolute(baseFolder) / out.scene;
  out.scene = out.scene.lexically_normal();
  if (p.has("size")) {
    p.at("size").array(2, 2);
    out.width = int(p.at("size").item(0).integer(1, kMaxPictureEdge));
    out.height = int(p.at("size").item(1).integer(1, kMaxPictureEdge));
  }
  out.timeStep_s = p.numberOr("time_step_s", out.timeStep_s, {0, 1e9});
  if (p.has("warm_up")) out.warmUp = int(p.at("warm_up").integer(0, 10000));
  const JsonPlace frames = p.at("frames");
  const auto n = frames.array(1, kMaxPathFrames);
  out.frames.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const JsonPlace f = frames.item(i);
    f.object({"position_m", "orientation_xyzw", "fov_deg", "time_s", "exposure_ev"});
    PathFrame frame;
    frame.view.position_m = f.at("position_m").vec3({-detail::kFarthest_m, detail::kFarthest_m});
    frame.view.orientation = f.at("orientation_xyzw").orientation();
    frame.view.fov_deg = f.numberOr("fov_deg", frame.view.fov_deg, detail::kFovRange_deg);
    frame.time_s = f.numberOr("time_s", double(i) * out.timeStep_s, {-kGreatestTime_s, kGreatestTime_s});
    if (f.has("exposure_ev")) frame.view.exposure_ev = f.at("exposure_ev").number(detail::kExposureRange_ev);
    out.frames.push_back(frame);
  }
  return out;
}

}  // namespace

Result<FlightPath> parsePath(std::string_view text, const std::string& sourceName, const fs::path& baseFolder) {
  try {
    const auto value = detail::parseJson(text, sourceName);
    return readPath({value, sourceName}, baseFolder);
  } catch (const InputError& error) {
    return Error{error.message};
  }
}

Result<FlightPath> loadPath(const fs::path& file) {
  auto text = readFile(file, kMaxPathBytes);
  if (!text) return text.error();
  auto path = parsePath(*text, file.string(), file.has_parent_path() ? file.parent_path() : fs::path("."));
  if (path) path->file = file;
  return path;
}

std::string pathToJson(const FlightPath& path, const fs::path& baseFolder) {
  const fs::path scene = baseFolder.empty()
                             ? path.scene
                             : fs::absolute(path.scene).lexically_normal().lexically_proximate(fs::absolute(baseFolder).lexically_normal());
  nlohmann::ordered_json head;
  if (!path.name.empty()) head["name"] = path.name;
  head["scene"] = scene.generic_string();
  head["size"] = {path.width, path.height};
  head["time_step_s"] = path.timeStep_s;
  head["warm_up"] = path.warmUp;
  std::string out = head.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  out.resize(out.size() - 2);  // "\n}": the frames follow, one a line
  out += ",\n \"frames\": [";
  for (std::size_t i = 0; i < path.frames.size(); ++i) {
    auto frame = detail::writeView(path.frames[i].view);
    frame["time_s"] = path.frames[i].time_s;
    out += (i ? ",\n  " : "\n  ") + frame.dump();
  }
  return out + "\n ]\n}\n";
}

Result<void> savePath(const FlightPath& path, const fs::path& file) {
  return writeFile(file, pathToJson(path, file.has_parent_path() ? file.parent_path() : fs::path(".")));
}

Result<void> checkPath(const FlightPath& path, const Planet& planet) {
  for (std::size_t i = 0; i < path.frames.size(); ++i) {
    if (detail::aboveGround(path.frames[i].view.position_m, planet.radius_m)) continue;
    return Error{
        fmt::format("{}: /frames/{}/position_m: expected a position above the ground, at least {} m from the planet's centre, got {} m",
                    path.file.string(), i, planet.radius_m, glm::length(path.frames[i].view.position_m))};
  }
  return {};
}

}  // namespace welkin
