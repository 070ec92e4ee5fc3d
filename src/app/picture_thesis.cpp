#include "picture_thesis.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "welkin/app/places.h"
#include "welkin/physics/scene_io.h"
#include "welkin/physics/scene_time.h"

namespace welkin::app {
namespace {

constexpr double kThesisRadius_m = 6'371'000;
const std::string kPosition = "mulen_camera_position", kOrientation = "mulen_camera_orientation", kFovy = "mulen_camera_fovy",
                  kLightTime = "mulen_atmosphere_light_time", kAnimationTime = "mulen_atmosphere_animation_time";

const std::string* find(const Texts& texts, const std::string& key) {
  const auto found = std::find_if(texts.begin(), texts.end(), [&](const auto& entry) { return entry.first == key; });
  return found == texts.end() ? nullptr : &found->second;
}

// Exactly n numbers between blanks; or none.
std::vector<double> numbers(const std::string& text, std::size_t n) {
  std::vector<double> out;
  const char *at = text.data(), *end = at + text.size();
  while (true) {
    while (at != end && (*at == ' ' || *at == '\t' || *at == '\n' || *at == '\r' || *at == ',')) ++at;
    if (at == end) break;
    double value = 0;
    const auto parsed = std::from_chars(at, end, value);
    if (parsed.ec != std::errc() || !std::isfinite(value)) return {};
    out.push_back(value);
    at = parsed.ptr;
  }
  return out.size() == n ? out : std::vector<double>{};
}

}  // namespace

bool isThesisPicture(const Texts& texts) { return find(texts, kPosition) != nullptr; }

Result<PictureState> stateOfThesisPicture(const Texts& texts, const std::filesystem::path& picture) {
  const auto bad = [&](const std::string& key, const char* expected) {
    return Error{fmt::format("{}: {}: expected {}", picture.string(), key, expected)};
  };
  PictureState s;
  const auto note = [&](const std::string& what) { s.notes.push_back(fmt::format("{}: {}", picture.string(), what)); };

  const auto p = numbers(*find(texts, kPosition), 3);
  if (p.empty()) return bad(kPosition, "three numbers: metres from the planet's centre");
  s.view.position_m = {p[0], p[1], p[2]};
  const double distance_m = glm::length(s.view.position_m);
  if (!(distance_m > 0 && distance_m < 1e12)) return bad(kPosition, "a position other than the centre, at most 1e12 m from it");
  if (const auto* text = find(texts, kOrientation)) {
    const auto q = numbers(*text, 4);
    if (q.empty()) return bad(kOrientation, "four numbers: x y z w");
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    if (!(std::abs(length - 1) < 2e-3)) return bad(kOrientation, "a unit quaternion x y z w");
    s.view.orientation = glm::dquat(q[3] / length, q[0] / length, q[1] / length, q[2] / length);
  } else {
    note(kOrientation + " is missing: the view looks along -Z");
  }
  if (const auto* text = find(texts, kFovy)) {
    const auto f = numbers(*text, 1);
    s.view.fov_deg = f.empty() ? 0 : f[0] * 180 / std::numbers::pi;
    if (!(s.view.fov_deg >= 0.0001 && s.view.fov_deg <= 179.9)) return bad(kFovy, "an angle of 0.0001 to 179.9 degrees, in radians");
  } else {
    note(kFovy + " is missing: the field of view is the default one");
  }
  if (const auto* text = find(texts, kAnimationTime)) {
    const auto t = numbers(*text, 1);
    if (t.empty() || !(std::abs(t[0]) <= kGreatestTime_s)) return bad(kAnimationTime, "a number of seconds up to 1e12");
    s.time_s = t[0];
  }

  const auto earth = programFolder() / "scenes" / "earth.json";
  auto scene = loadScene(earth);
  if (!scene) return Error{fmt::format("{}: its camera needs a scene: {}", picture.string(), scene.error().message)};
  s.scene = std::move(*scene);
  s.scene.planet.radius_m = kThesisRadius_m;
  s.scene.file = picture;
  s.scene.views.clear();
  if (s.scene.sun) s.scene.sun->day_s = 0;  // its animation is of the clouds' shapes
  if (s.scene.clouds) s.scene.clouds->windEast_m_per_s = 0;
  note("a picture of the thesis program: its camera over scenes/earth.json with a radius of 6371 km");
  if (find(texts, kLightTime) != nullptr) note(kLightTime + " is left out: the sun stands where the scene has it");
  if (distance_m < kThesisRadius_m) {
    s.view.position_m *= (kThesisRadius_m + 1.5) / distance_m;
    note("its camera was below the ground: brought 1.5 m above it");
  }
  return s;
}

}  // namespace welkin::app
