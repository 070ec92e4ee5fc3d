#include "welkin/app/recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "welkin/app/picture.h"
#include "welkin/app/places.h"
#include "welkin/physics/scene_io.h"

namespace welkin::app {
namespace fs = std::filesystem;
namespace {

// A step's time i * step and a frame's own, added up from many, differ by rounding: within it they are the same moment.
constexpr double kSameMoment_s = 1e-7;

bool finite(const View& v) {
  const auto& p = v.position_m;
  const auto& q = v.orientation;
  return std::isfinite(p.x + p.y + p.z) && std::isfinite(q.x + q.y + q.z + q.w) && std::isfinite(v.fov_deg);
}

}  // namespace

View viewBetween(const View& a, const View& b, double part) {
  if (!(part > 0)) return a;
  if (part >= 1) return b;
  View out = part < 0.5 ? a : b;
  out.fov_deg = std::lerp(a.fov_deg, b.fov_deg, part);
  if (a.exposure_ev && b.exposure_ev) out.exposure_ev = std::lerp(*a.exposure_ev, *b.exposure_ev, part);
  const double ra = glm::length(a.position_m), rb = glm::length(b.position_m);
  glm::dquat carry(1, 0, 0, 0), whole = carry;
  glm::dvec3 direction = ra > 0 ? a.position_m / ra : b.position_m / std::max(rb, 1e-300);
  if (ra > 0 && rb > 0) {
    const glm::dvec3 across = glm::cross(direction, b.position_m / rb);
    const double angle = std::atan2(glm::length(across), glm::dot(direction, b.position_m / rb));
    if (glm::length(across) > 0) {
      const glm::dvec3 axis = glm::normalize(across);
      carry = glm::angleAxis(angle * part, axis);
      whole = glm::angleAxis(angle, axis);
    }
  }
  out.position_m = glm::normalize(carry * direction) * std::lerp(ra, rb, part);
  out.orientation = glm::normalize(carry * glm::slerp(a.orientation, glm::conjugate(whole) * b.orientation, part));
  return out;
}

bool Recording::add(double at_s, const View& view, double time_s) {
  if (!std::isfinite(at_s) || !std::isfinite(time_s) || !finite(view) || frames_.size() >= std::size_t(kMaxPathFrames)) return false;
  if (!frames_.empty() && at_s <= frames_.back().at_s) {
    frames_.back() = {frames_.back().at_s, view, time_s};
  } else {
    frames_.push_back({at_s, view, time_s});
  }
  return true;
}

LiveFrame Recording::at(double time_s) const {
  const double t = frames_.front().at_s + time_s;
  const auto later =
      std::lower_bound(frames_.begin(), frames_.end(), t - kSameMoment_s, [](const LiveFrame& f, double s) { return f.at_s < s; });
  if (later == frames_.end()) return frames_.back();
  if (later == frames_.begin() || later->at_s <= t + kSameMoment_s) return *later;
  const LiveFrame &a = *(later - 1), &b = *later;
  const double part = (t - a.at_s) / (b.at_s - a.at_s);
  return {t, viewBetween(a.view, b.view, part), std::lerp(a.time_s, b.time_s, part)};
}

Result<FlightPath> Recording::path(double timeStep_s) const {
  if (frames_.empty()) return Error{"nothing is recorded"};
  if (!(timeStep_s > 0)) return Error{"expected a time step over 0 s"};
  const double steps = std::floor((duration_s() + kSameMoment_s) / timeStep_s);
  if (steps >= kMaxPathFrames) return Error{fmt::format("expected at most {} frames, got {:.0f}", kMaxPathFrames, steps + 1)};
  FlightPath out;
  out.timeStep_s = timeStep_s;
  for (int i = 0; i <= int(steps); ++i) {
    const LiveFrame frame = at(i * timeStep_s);
    out.frames.push_back({frame.view, frame.time_s});
  }
  return out;
}

Result<fs::path> saveRecorded(FlightPath path, const Scene& scene, bool sceneChanged, const fs::path& folder, const std::string& stem) {
  if (auto above = checkPath(path, scene.planet); !above) return above.error();
  std::error_code ec;
  const bool copy = sceneChanged || !fs::is_regular_file(scene.file, ec) || kindOfName(scene.file) != PictureKind::None;
  const auto name = reserveFiles(folder, stem, copy ? std::vector<std::string>{".json", ".scene.json"} : std::vector<std::string>{".json"});
  if (!name) return name.error();
  const fs::path file = name->string() + ".json", sceneFile = name->string() + ".scene.json";
  path.scene = copy ? sceneFile : scene.file;
  Result<void> written = copy ? saveScene(scene, sceneFile) : Result<void>();
  if (written) written = savePath(path, file);
  if (written) return file;
  fs::remove(file, ec);
  if (copy) fs::remove(sceneFile, ec);
  return written.error();
}

}  // namespace welkin::app
