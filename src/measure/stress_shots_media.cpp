#include <cmath>

#include "stress_maker.h"

namespace welkin::measure {

void ShotMaker::depths() {
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

void ShotMaker::times() {
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

void ShotMaker::densities() {
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

void ShotMaker::airs() {
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

}  // namespace welkin::measure
