#include <cmath>
#include <numbers>

#include "stress_maker.h"
#include "welkin/physics/root_frame.h"
#include "welkin/physics/scene_io.h"

namespace welkin::measure {

void ShotMaker::radii() {
  const char* axis = "radius of the planet, m";
  for (const double r : some({100, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8})) {
    auto& ball = stage(bare(r));
    for (const double h : {1e-3, 0.1 * r, 10 * r})
      ball.shots.push_back(
          {axis, r, h < 1 ? "ball, on the ground" : "ball, whole", h < 1 ? from(r, h, 40, 0) : whole(r, h), ShotTruth::Ground, {}, 0});
    const double scale = 1.25e-3 * r;
    auto& air = stage(clearAir(r, scale, 0.2));
    air.shots.push_back({axis, r, "air, on the ground", from(r, 1e-3 * r, 60, 20), ShotTruth::SingleOrder, {}, 0});
    air.shots.push_back({axis, r, "air, from space", whole(r, r), ShotTruth::SingleOrder, {}, 0});
    auto& cloud = stage(slabClouds(2e-4, r));
    cloud.shots.push_back({axis, r, "cloud, below it", from(r, 2, 0, 30), ShotTruth::SlabOpacity, {}, 0});
    cloud.shots.push_back({axis, r, "cloud, inside it", from(r, kInside_m, 60, 0), ShotTruth::SlabOpacity, {}, 0});
    cloud.shots.push_back({axis, r, "cloud, from space", whole(r, 2 * r + 50e3), ShotTruth::SlabOpacity, {}, 0});
  }
}

void ShotMaker::altitudes() {
  const char* axis = "altitude of the camera, m";
  auto ball = bare(), air = clearAir(kEarth_m, 8000, 0.2), cloud = slabClouds(2e-4), all = earth();
  const std::vector<double> heights = some({1e-3, 1, 1e2, 3e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10});
  const auto add = [&](ShotStage& s, const char* what, ShotTruth truth) {
    for (const double h : heights) {
      if (h <= 1e6) s.shots.push_back({axis, h, std::string(what) + ", level", from(kEarth_m, h, 70, h > 2e4 ? -20 : 2), truth, {}, 0});
      if (h >= 1e3)
        s.shots.push_back(
            {axis, h, std::string(what) + ", down", h > 1e6 ? whole(kEarth_m, h) : from(kEarth_m, h, 0, -90), truth, {}, 0});
    }
  };
  add(stage(ball), "ball", ShotTruth::Ground);
  add(stage(air), "air", ShotTruth::SingleOrder);
  add(stage(cloud), "cloud", ShotTruth::SlabOpacity);
  add(stage(all), "all", ShotTruth::None);
}

void ShotMaker::places() {
  const char* axis = "place of the camera";
  const Scene scene = slabClouds(2e-4);
  const RootFrame root = RootFrame::enclosing(kEarth_m, 20'000);
  const double node = root.nodeSize_m(std::uint32_t(scene.quality.depth)), r = kEarth_m;
  // On faces of nodes of all levels at once (y = z = 0), and of the deepest level along x.
  const double face = std::ceil((r + kInside_m + root.half_m) / node) * node - root.half_m;
  struct Place {
    const char* name;
    glm::dvec3 at, towards;
  };
  const std::vector<Place> all{
      {"inside a voxel, up", directionTo(21, 33) * (r + kInside_m + 304.3), directionTo(21, 33)},
      {"inside a voxel, level", directionTo(21, 33) * (r + kInside_m + 304.3), {0, 0, 1}},
      {"on a brick's corner, along an edge", {face, 0, 0}, {0, 1, 0}},
      {"on a brick's corner, along another", {face, 0, 0}, {0, 0, 1}},
      {"on a brick's corner, up", {face, 0, 0}, {1, 0, 0}},
      {"on a brick's corner, down", {face, 0, 0}, {-1, 0, 0}},
      {"on a brick's corner, along a diagonal", {face, 0, 0}, {1, 1, 1}},
      {"on the axis, up", {0, 0, r + kInside_m}, {0, 0, 1}},
      {"on the axis, down from space", {0, 0, 3 * r}, {0, 0, -1}},
      {"on the axis, level", {0, 0, r + kInside_m}, {1, 0, 0}},
      {"1 m below the ground", directionTo(21, 33) * (r - 1), directionTo(21, 33)},
      {"100 km below the ground", directionTo(21, 33) * (r - 1e5), {0, 1, 0}},
      {"at the planet's centre", {0, 0, 0}, {1, 0, 0}},
  };
  auto& clouds = stage(scene);
  for (std::size_t i = 0; i < all.size(); i += quick ? 2 : 1)
    clouds.shots.push_back(
        {axis, double(i), std::string("cloud, ") + all[i].name, look(all[i].at, all[i].towards), ShotTruth::SlabOpacity, {}, 0});
  auto& air = stage(clearAir(kEarth_m, 8000, 0.2));
  for (std::size_t i = 7; i < all.size(); ++i)
    air.shots.push_back(
        {axis, double(i), std::string("air, ") + all[i].name, look(all[i].at, all[i].towards), ShotTruth::SingleOrder, {}, 0});
}

void ShotMaker::suns() {
  const char* axis = "zenith angle of the sun, degrees";
  std::vector<double> angles{0, 15, 30, 45, 60, 75, 85, 89, 89.999, 90, 90.001, 91, 95, 105, 120, 135, 150, 165, 180};
  if (quick) angles = {0, 60, 90, 180};
  for (const double a : angles) {
    const glm::dvec3 sun = directionTo(90 - std::min(a, 180.0), 0);  // the camera stands on the north pole
    const double c = std::cos(a * std::numbers::pi / 180), s = std::sin(a * std::numbers::pi / 180);
    const glm::dvec3 toSun = a == 0 || a == 180 ? sun : glm::dvec3(s, 0, c);
    const auto lit = [&](Scene scene) {
      scene.sun->direction_planet = toSun;
      return scene;
    };
    const glm::dvec3 eye{0, 0, kEarth_m + 2};
    auto& ball = stage(lit(bare()));
    auto& air = stage(lit(clearAir(kEarth_m, 8000, 0.2)));
    std::vector<ShotStage*> of{&ball, &air};
    ShotStage* all = quick && a != 60 ? nullptr : &stage(lit(earth()));
    if (all != nullptr) of.push_back(all);
    for (auto* st : of) {
      const auto truth = st == &ball ? ShotTruth::Ground : st == &air ? ShotTruth::SingleOrder : ShotTruth::None;
      const char* what = st == &ball ? "ball, " : st == &air ? "air, " : "all, ";
      st->shots.push_back({axis, a, std::string(what) + "exactly towards the sun", look(eye, toSun), truth, {}, 0});
      st->shots.push_back({axis, a, std::string(what) + "exactly away from the sun", look(eye, -toSun), truth, {}, 0});
      st->shots.push_back({axis, a, std::string(what) + "level, from 9 km", look({0, 0, kEarth_m + 9000}, {1, 0, -0.1}), truth, {}, 0});
    }
  }
}

void ShotMaker::fields() {
  const char* axis = "field of view, degrees";
  std::vector<double> angles = some({0.001, 0.01, 0.1, 1, 10, 60, 120, 170, 175, 179, 179.9});
  auto ball = bare(), air = clearAir(kEarth_m, 8000, 0.2), cloud = slabClouds(2e-4), all = earth();
  const auto add = [&](ShotStage& s, const char* what, ShotTruth truth) {
    for (const double a : angles) {
      s.shots.push_back({axis, a, std::string(what) + ", on the ground", from(kEarth_m, 2, 90, 0.3, a), truth, {}, 0});
      s.shots.push_back({axis, a, std::string(what) + ", from space", from(kEarth_m, 4e5, 30, -20, a), truth, {}, 0});
    }
    s.shots.push_back({axis, 0.001, std::string(what) + ", from 1e10 m", from(kEarth_m, 1e10, 0, -90, 0.001), truth, {}, 0});
  };
  add(stage(ball), "ball", ShotTruth::Ground);
  add(stage(air), "air", ShotTruth::SingleOrder);
  add(stage(cloud), "cloud", ShotTruth::SlabOpacity);
  add(stage(all), "all", ShotTruth::None);
}

void ShotMaker::sizes() {
  const char* axis = "pixels of the picture";
  std::vector<std::pair<int, int>> sizes{{1, 1}, {2, 1}, {3, 5}, {7680, 1}, {1, 4320}};
  if (quick) sizes = {{1, 1}, {1, 4320}, {7680, 1}};
  for (const auto& [w, h] : sizes) {
    for (int kind = 0; kind < 2; ++kind) {
      auto& s = stage(kind == 0 ? bare() : slabClouds(2e-4));
      s.width = w, s.height = h;
      const std::string text = std::string(kind == 0 ? "ball, " : "cloud, ") + std::to_string(w) + "x" + std::to_string(h);
      s.shots.push_back({axis,
                         double(w) * h,
                         text,
                         from(kEarth_m, 9000, 30, -12, w > 100 ? 0.01 : 58),
                         kind == 0 ? ShotTruth::Ground : ShotTruth::SlabOpacity,
                         {},
                         0});
    }
  }
}

// One pixel whose ray passes the ground, or the cloud's top, by a millimetre.
void ShotMaker::grazing() {
  const char* axis = "height of the tangent point, m";
  auto ball = bare(), air = clearAir(kEarth_m, 8000, 0.2), cloud = slabClouds(2e-4);
  struct Kind {
    Scene* scene;
    const char* name;
    double over_m;
    ShotTruth truth;
  };
  for (const Kind& k : {Kind{&ball, "ball", 0, ShotTruth::Ground},
                        {&air, "air", 0, ShotTruth::SingleOrder},
                        {&cloud, "cloud's top", kTop_m, ShotTruth::None}}) {
    auto& s = stage(*k.scene);
    s.width = s.height = 1;
    for (const double h : {2.0, 1e4, 4e5, 1e8}) {
      for (const double tangent : {-1e-3, 1e-3}) {
        const double r = kEarth_m + h + (k.over_m > h ? k.over_m : 0), sine = (kEarth_m + k.over_m + tangent) / r;
        if (sine > 1) continue;
        const double cosine = -std::sqrt((1 - sine) * (1 + sine));
        s.shots.push_back({axis,
                           tangent,
                           std::string(k.name) + ", from " + std::to_string(long(r - kEarth_m)) + " m",
                           look({r, 0, 0}, {cosine, sine, 0}, 1e-4),
                           k.truth,
                           {},
                           0});
      }
    }
  }
}

}  // namespace welkin::measure
