#include "stress_shots.h"

#include <cmath>
#include <numbers>

#include "welkin/physics/air.h"
#include "welkin/physics/root_frame.h"
#include "welkin/physics/scene_io.h"

namespace welkin::measure {
namespace {

constexpr double kEarth_m = 6'360'000;

View look(glm::dvec3 position, glm::dvec3 forward, double fov_deg = 58) {
  View v;
  v.position_m = position;
  const glm::dvec3 f = glm::normalize(forward);
  v.orientation = glm::quatLookAt(f, std::abs(f.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0));
  v.fov_deg = fov_deg;
  return v;
}
View from(double radius, double altitude, double heading_deg, double pitch_deg, double fov_deg = 58, double lat = 20, double lon = 10) {
  return toView({lat, lon, altitude, heading_deg, pitch_deg, 0, fov_deg, {}}, radius);
}
// From so far that the planet just fills the picture.
View whole(double radius, double altitude, double lat = 20, double lon = 10) {
  const double half = std::asin(radius / (radius + altitude)) * 180 / std::numbers::pi;
  return from(radius, altitude, 0, -90, std::min(2.4 * half, 150.0), lat, lon);
}

Scene bare(double radius = kEarth_m) {
  Scene s;
  s.name = "bare ball";
  s.planet = {radius, {0.5, 0.5, 0.5}, {}};
  s.sun = Sun{{1, 1, 1}, 0.004675, directionTo(10, 40)};
  s.quality.budget_bytes = 64ull << 20;
  return s;
}

// One exponential layer, of this optical depth straight up; single scattering, which the reference knows.
Scene clearAir(double radius, double scale_m, double depth, PhaseType phase = PhaseType::Rayleigh, double g = 0) {
  Scene s = bare(radius);
  s.name = "one layer of air";
  const double k = depth / scale_m;
  AirLayer layer{"air", ExponentialProfile{scale_m}, {k, k, k}, {0, 0, 0}, phase, g};
  s.atmosphere = Atmosphere{std::max(12.0, 12 + std::log(depth)) * scale_m, "march", {layer}};
  return s;
}

// So high that voxels are small against it: what is measured is the march, not the voxels.
constexpr double kBase_m = 2000, kTop_m = 18'000, kInside_m = 9000;
Scene slabClouds(double extinction_per_m, double radius = kEarth_m) {
  Scene s = bare(radius);
  s.name = "an even shell of cloud";
  s.clouds = Clouds{{SlabSource{kBase_m, kTop_m, extinction_per_m}}, true};
  s.quality.depth = 13;
  s.quality.detail = 8;
  return s;
}

Scene earth(const char* model = "tables-2d") {
  Scene s = bare();
  s.name = "clouds and air";
  s.planet.albedo = {0.06, 0.07, 0.10};
  s.atmosphere = earthAir();
  s.atmosphere->model = model;
  s.clouds = Clouds{{LayersSource{}}, true};
  s.quality.depth = 12;
  s.quality.detail = 8;
  return s;
}

struct Maker {
  bool quick;
  std::deque<ShotStage> stages;  // of which references stay good

  // Of a list, in small: the first, the last and the middle.
  std::vector<double> some(std::vector<double> all) const {
    if (!quick || all.size() < 4) return all;
    return {all.front(), all[all.size() / 2], all.back()};
  }
  ShotStage& stage(Scene scene) {
    if (quick && scene.quality.depth <= 13) scene.quality.budget_bytes = (scene.atmosphere ? 32ull : 24ull) << 20;
    if (quick && scene.quality.detail > 0) scene.quality.detail = scene.atmosphere ? 3 : 6;
    stages.push_back({std::move(scene), quick ? 32 : 48, quick ? 18 : 27, {}, false, false});
    return stages.back();
  }

  void radii() {
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

  void altitudes() {
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

  void places() {
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

  void suns() {
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

  void fields() {
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

  void sizes() {
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
  void grazing() {
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

  void depths() {
    const char* axis = "depth of the tree";
    std::vector<double> all{1, 2, 3, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24};
    if (quick) all = {1, 8, 24};
    for (const double d : all) {
      Scene scene = slabClouds(2e-4);
      scene.quality.depth = int(d);
      scene.quality.detail = 0;
      scene.quality.budget_bytes = 48ull << 20;
      auto& s = stage(scene);
      // Voxels of the first levels are wider than the cloud is high: of these only the bounds are asked.
      const auto truth = d >= 12 ? ShotTruth::SlabOpacity : ShotTruth::None;
      s.shots.push_back({axis, d, "cloud, below it", from(kEarth_m, 2, 0, 30), truth, {}, 0});
      s.shots.push_back({axis, d, "cloud, inside it", from(kEarth_m, kInside_m, 60, 0), truth, {}, 0});
      s.shots.push_back({axis, d, "cloud, from orbit", from(kEarth_m, 4e5, 60, -30), ShotTruth::None, {}, 0});
    }
    for (const double d : quick ? std::vector<double>{8} : std::vector<double>{1, 6, 16, 24}) {
      Scene scene = earth();
      scene.quality.depth = int(d);
      scene.quality.detail = 0;
      auto& s = stage(scene);
      s.leastBudget = true;
      s.shots.push_back({"least budget, depth of the tree", d, "all, inside a cloud", from(kEarth_m, 1500, 60, 0), ShotTruth::None, {}, 0});
      s.shots.push_back({"least budget, depth of the tree", d, "all, from orbit", from(kEarth_m, 4e5, 60, -30), ShotTruth::None, {}, 0});
    }
  }

  void times() {
    const int frames = quick ? 6 : 12;
    const auto lightAndDark = [&] {
      std::vector<View> path;
      for (int i = 0; i < frames; ++i) path.push_back(i % 4 < 2 ? from(kEarth_m, 1500, 60, 0) : from(kEarth_m, 1500, 60, 0, 58, -20, -150));
      return path;
    };
    auto metered = earth();
    metered.output.exposure_ev.reset();
    auto& s = stage(metered);
    for (const double dt : {1e-6, 1e-3, 10.0})
      s.shots.push_back(
          {"time of a frame, s", dt, "all, day and night by turns", from(kEarth_m, 1500, 60, 0), ShotTruth::None, lightAndDark(), dt});
    std::vector<View> jumps;
    for (int i = 0; i < (quick ? 8 : 40); ++i) {
      const double golden = 0.6180339887 * i, h = std::pow(10.0, -3 + 13 * (golden - std::floor(golden)));
      jumps.push_back(h > 1e6 ? whole(kEarth_m, h, 40 * std::sin(i), 37.0 * i)
                              : from(kEarth_m, h, 50.0 * i, h > 2e4 ? -40 : 5, 58, 40 * std::sin(i), 37.0 * i));
    }
    s.shots.push_back({"frames between teleports", 1, "all, 1 mm to 1e10 m", jumps.front(), ShotTruth::None, jumps, 1.0 / 60});
  }

  void densities() {
    const char* axis = "density, of the Earth's clouds";
    std::vector<double> all{0, 1e-3, 1e-2, 0.1, 1, 10, 100, 1e3, 1e4, 1e5, 1e6};
    if (quick) all = {0, 1, 1e6};
    for (const double f : all) {
      Scene scene = slabClouds(0.05 * f);
      scene.quality.depth = 16;
      auto& s = stage(scene);
      s.everyIntegrator = true;
      const auto truth = f <= 10 ? ShotTruth::FineMarch : ShotTruth::None;  // in denser clouds a 32nd of the step still is thick
      s.shots.push_back({axis, f, "cloud, below it", from(kEarth_m, 2, 0, 30), truth, {}, 0});
      s.shots.push_back({axis, f, "cloud, inside it", from(kEarth_m, kTop_m - 100, 60, 20), truth, {}, 0});
      s.shots.push_back({axis, f, "cloud, from above", from(kEarth_m, 4e4, 60, -40), truth, {}, 0});
      if (quick && f != 1) continue;
      auto& opaque = stage(slabClouds(0.05 * f));
      opaque.shots.push_back({axis, f, "cloud, opacity from above", from(kEarth_m, 4e4, 60, -40), ShotTruth::SlabOpacity, {}, 0});
    }
  }

  void airs() {
    for (const double scale : some({1, 10, 100, 1e3, 1e4, 1e5})) {
      auto& s = stage(clearAir(kEarth_m, scale, 0.2));
      s.shots.push_back(
          {"scale height of the air, m", scale, "air, on the ground", from(kEarth_m, 0.3 * scale, 60, 20), ShotTruth::SingleOrder, {}, 0});
      s.shots.push_back(
          {"scale height of the air, m", scale, "air, from above it", from(kEarth_m, 40 * scale, 60, -30), ShotTruth::SingleOrder, {}, 0});
    }
    for (const double depth : some({1e-6, 1e-3, 0.1, 1, 10, 1e2, 1e3, 1e4, 1e6})) {
      auto& s = stage(clearAir(kEarth_m, 8000, depth));
      s.shots.push_back(
          {"optical depth of the air, straight up", depth, "air, on the ground", from(kEarth_m, 2, 60, 20), ShotTruth::SingleOrder, {}, 0});
      s.shots.push_back(
          {"optical depth of the air, straight up", depth, "air, from space", from(kEarth_m, 4e5, 60, -30), ShotTruth::SingleOrder, {}, 0});
      Scene orders = clearAir(kEarth_m, 8000, depth);
      orders.atmosphere->model = "tables-2d";
      orders.planet.albedo = {1, 1, 1};
      auto& furnace = stage(orders);
      furnace.shots.push_back({"optical depth of the air, straight up",
                               depth,
                               "all orders over white ground, on the ground",
                               from(kEarth_m, 2, 60, 20),
                               ShotTruth::None,
                               {},
                               0});
      furnace.shots.push_back({"optical depth of the air, straight up",
                               depth,
                               "all orders over white ground, from space",
                               from(kEarth_m, 4e5, 60, -30),
                               ShotTruth::None,
                               {},
                               0});
    }
    for (const double g : some({-0.999, -0.8, 0, 0.8, 0.99, 0.999})) {
      auto& s = stage(clearAir(kEarth_m, 8000, 0.2, PhaseType::HenyeyGreenstein, g));
      s.shots.push_back(
          {"mean cosine of the air's phase function", g, "air, on the ground", from(kEarth_m, 2, 40, 20), ShotTruth::SingleOrder, {}, 0});
      s.shots.push_back(
          {"mean cosine of the air's phase function", g, "air, from space", from(kEarth_m, 4e5, 60, -30), ShotTruth::SingleOrder, {}, 0});
    }
  }
};

}  // namespace

std::deque<ShotStage> stressStages(bool quick) {
  Maker m{quick, {}};
  m.radii(), m.altitudes(), m.places(), m.suns(), m.fields(), m.sizes(), m.grazing(), m.depths(), m.times(), m.densities(), m.airs();
  return std::move(m.stages);
}

}  // namespace welkin::measure
