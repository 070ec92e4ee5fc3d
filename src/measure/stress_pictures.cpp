// Draws the pictures of the stability matrix with the renderer itself and holds every pixel to its bounds and, where there is one, a truth.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "stress_shots.h"
#include "welkin/clouds/density_source.h"
#include "welkin/measure/stress.h"
#include "welkin/physics/air.h"
#include "welkin/physics/root_frame.h"
#include "welkin/reference/radiance.h"
#include "welkin/render/renderer.h"
#include "welkin/shared/cloud_light.glsl.h"
#include "welkin/shared/ground.glsl.h"
#include "welkin/shared/step_rules.glsl.h"

namespace welkin::measure {
namespace {

constexpr double kPi = std::numbers::pi;
// Of a march against its own at a 32nd of the step. The default step is chosen for the Earth's clouds, of which it shows an RMSE below 1 %;
// in the first voxel of a cloud that is as hard as a wall it may be off by more, as long as it stays in bounds.
constexpr double kMarchLimit = 0.1;
constexpr double kNight =
    1e-6;  // of the sun's irradiance, 1/sr: a hundred thousandth of the day's sky. Light below it is no light to be off from

struct Camera {
  glm::dvec3 position, forward, right, up;  // right and up times the tangent of half the field
  double r, pixel_rad;
};
// As the renderer has it: below the ground it stands on it.
Camera cameraOf(const View& v, double radius_m, int width, int height) {
  Camera c;
  c.position = v.position_m;
  const double least = radius_m + 0.001, from = glm::length(v.position_m);
  if (from < least) c.position = from > 0 ? v.position_m * (least / from) : glm::dvec3(0, 0, least);
  const double tanY = std::tan(v.fov_deg * kPi / 360);
  c.forward = v.orientation * glm::dvec3(0, 0, -1);
  c.right = v.orientation * glm::dvec3(1, 0, 0) * (tanY * width / height);
  c.up = v.orientation * glm::dvec3(0, 1, 0) * tanY;
  c.r = glm::length(c.position);
  c.pixel_rad = 2 * tanY / height;
  return c;
}
glm::dvec3 direction(const Camera& c, int x, int y, int width, int height) {
  return glm::normalize(c.forward + c.right * ((x + 0.5) / width * 2 - 1) + c.up * (1 - (y + 0.5) / height * 2));
}
double angleBetween(glm::dvec3 a, glm::dvec3 b) { return 2 * std::asin(std::min(0.5 * glm::length(a - b), 1.0)); }

// Part of the ray in front of the camera that lies inside a sphere; far < near: none. Free of cancellation (shared/camera.glsl.h).
struct Part {
  double near, far;
};
Part inside(const Camera& c, glm::dvec3 dir, double radius) {
  const double b = glm::dot(c.position, dir), q = (c.r - radius) * (c.r + radius), disc = b * b - q;
  if (disc < 0 || (q > 0 && b >= 0)) return {1, 0};
  const double root = std::sqrt(disc);
  if (q > 0) return {q / (root - b), root - b};
  return {0, b < 0 ? root - b : -q / (b + root)};
}

// The most that one pixel may show: the sun's disc if it is near, the sun's irradiance times the sharpest phase function of what is there,
// all of it scattered once; and light without direction: ground, sky, and what is scattered more often, of at most the irradiance.
double bound(const Scene& scene, const Camera& c, glm::dvec3 dir) {
  if (!scene.sun) return 0;
  const glm::dvec3 sun = scene.sun->direction_planet;
  const double cosSun = glm::dot(dir, sun), angle = angleBetween(dir, sun), pixel_rad = c.pixel_rad;
  double most = 1 + 2 / kPi;
  if (const Part ground = inside(c, dir, scene.planet.radius_m); ground.near <= ground.far) {
    const auto& a = scene.planet.albedo;
    const glm::vec3 normal((c.position + dir * ground.near) / scene.planet.radius_m);
    const float water = shared::waterFraction({float(a[0]), float(a[1]), float(a[2])});
    most += 1.2 * water *
            shared::waterGlint(glm::normalize(normal), glm::vec3(sun), glm::vec3(-dir));  // steep at the horizon: a rounding counts
  }
  const double r = scene.sun->angularRadius_rad, drawn2 = std::max(r * r, pixel_rad * pixel_rad / 3);
  if (r > 0 && angle < r + 2 * pixel_rad) most += 1.36 / (kPi * drawn2);  // limb darkening: 1 / (1 - 0.78 / 3) in the middle
  if (scene.clouds) {
    const auto phases = shared::cloudPhases(float(cosSun));
    double cloud = 0;
    for (int i = 0; i <= 64; ++i) cloud = std::max(cloud, double(shared::sunSource(phases, float(i) / 64)));
    most += 1.01 * cloud;
  }
  if (scene.atmosphere) {
    double air = 0;
    for (const AirLayer& l : scene.atmosphere->layers) {
      const auto phase = shared::phaseValue(shared::uint(l.phase), float(l.g), float(cosSun));
      air = std::max(air, double(phase));
    }
    most += 1.02 * air;  // the phase tables' and half floats' rounding
  }
  return most * *std::max_element(scene.sun->irradiance.begin(), scene.sun->irradiance.end()) + 1e-6;
}

struct Judged {
  double worst = 0;
  bool any = false;
  void add(double error) { worst = std::isfinite(error) ? std::max(worst, error) : HUGE_VAL, any = true; }
};

// Lambert's ground in the sun; space is black. Left out: pixels at the limb, where a rounding decides, and at the sun's disc.
void judgeGround(const Scene& scene, const Camera& c, const ImageF& image, Judged& judged) {
  const glm::dvec3 sun = scene.sun->direction_planet;
  const double albedo = scene.planet.albedo[1], radius = scene.planet.radius_m;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const glm::dvec3 dir = direction(c, x, y, image.width, image.height);
      if (angleBetween(dir, sun) < scene.sun->angularRadius_rad + 2 * c.pixel_rad) continue;
      const double b = glm::dot(c.position, dir), q = (c.r - radius) * (c.r + radius);
      if (std::abs(b * b - q) < 1e-12 * b * b) continue;
      const Part ground = inside(c, dir, radius);
      double light = 0;
      if (ground.near <= ground.far) {
        const glm::dvec3 normal = (c.position + dir * ground.near) / radius;
        light = std::max(glm::dot(normal, sun), 0.0);
      }
      judged.add(std::abs(image.rgba[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4 + 1] * kPi / albedo - light));
    }
  }
}

// Root mean square over the picture, of 1: the shell's faces are a voxel deep, so single pixels at its limb differ. Left out: pixels that
// miss it, or are wider there than a quarter of its height: so are the voxels that they see.
void judgeSlab(const Scene& scene, const Camera& c, const ImageF& image, Judged& judged) {
  const auto& slab = std::get<SlabSource>(scene.clouds->sources.front());
  const double radius = scene.planet.radius_m;
  double squares = 0, pixels = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const glm::dvec3 dir = direction(c, x, y, image.width, image.height);
      const Part ground = inside(c, dir, radius), outer = inside(c, dir, radius + slab.top_m), inner = inside(c, dir, radius + slab.base_m);
      const double end = ground.near <= ground.far ? ground.near : HUGE_VAL;
      const auto length = [&](const Part& p) { return std::max(std::min(p.far, end) - p.near, 0.0); };
      const double way = (outer.near <= outer.far ? length(outer) : 0) - (inner.near <= inner.far ? length(inner) : 0);
      if (outer.near > outer.far || std::min(outer.far, end) * c.pixel_rad > 0.25 * (slab.top_m - slab.base_m)) continue;
      ++pixels;
      const double difference =
          image.rgba[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4 + 3] + std::expm1(-slab.extinction_per_m * way);
      squares += difference * difference;
    }
  }
  if (pixels > 0) judged.add(std::sqrt(squares / pixels));
}

// A dozen pixels spread over the picture, over the brightest of their truths, or kNight.
void judgeAir(const Scene& scene, const Camera& c, const ImageF& image, Judged& judged) {
  const auto medium = reference::makeMedium(scene);
  if (!medium) return judged.add(HUGE_VAL);
  const glm::dvec3 up = c.position / c.r, sun = scene.sun->direction_planet;
  double brightest = kNight, apart = 0;
  for (int i = 0; i < 12; ++i) {
    const int x = int((i % 4 + 0.5) / 4 * image.width), y = int((i / 4 + 0.5) / 3 * image.height);
    const glm::dvec3 dir = direction(c, x, y, image.width, image.height);
    if (angleBetween(dir, sun) < scene.sun->angularRadius_rad + 2 * c.pixel_rad) continue;
    ProbeRay ray;
    ray.altitude_m = c.r - scene.planet.radius_m;
    ray.viewZenith_rad = angleBetween(dir, up), ray.sunZenith_rad = angleBetween(sun, up);
    const glm::dvec3 a = sun - up * glm::dot(sun, up), b = dir - up * glm::dot(dir, up);
    ray.azimuth_rad = glm::length(a) > 1e-12 && glm::length(b) > 1e-12 ? angleBetween(glm::normalize(a), glm::normalize(b)) : 0;
    const double truth = reference::singleOrderRadiance(*medium, ray).radiance[1];
    brightest = std::max(brightest, truth);
    apart = std::max(apart, std::abs(image.rgba[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4 + 1] - truth));
  }
  judged.add(apart / brightest);
}

// Root mean square of the difference over that of the light.
void judgeMarch(const ImageF& image, const ImageF& fine, Judged& judged) {
  double apart = 0, light = 0;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    if (i % 4 == 3) continue;
    apart += std::pow(double(image.rgba[i]) - fine.rgba[i], 2), light += std::pow(double(fine.rgba[i]), 2);
  }
  judged.add(light > 0 ? std::sqrt(apart / light) : apart > 0 ? HUGE_VAL : 0);
}

struct Studio {
  const ShotStage& stage;
  Renderer& renderer;
  std::vector<StressCell>& cells;

  void count(const View& view, const FrameStats& stats, StressCell& cell) const {
    const ImageF image = renderer.radiance();
    const Camera c = cameraOf(view, stage.scene.planet.radius_m, image.width, image.height);
    std::uint64_t painted = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const float* p = &image.rgba[(std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4];
        const glm::dvec3 dir = direction(c, x, y, image.width, image.height);
        const double most = bound(stage.scene, c, dir);
        bool nan = false, inf = false, negative = false, over = p[3] > 1 + 1e-6f;
        for (int k = 0; k < 4; ++k) nan |= std::isnan(p[k]), inf |= std::isinf(p[k]), negative |= p[k]<0, over |= p[k]> most && k < 3;
        cell.nan += nan, cell.inf += inf, cell.negative += negative, cell.overFurnace += over;
        painted += nan || inf;
      }
    }
    cell.rays += std::uint64_t(image.width) * std::uint64_t(image.height);
    if (stats.counters.nanPixels > painted) cell.nan += stats.counters.nanPixels - painted;
    if (!std::isfinite(stats.exposure_ev)) cell.note = "the exposure is not finite";
    if (stats.bytesUsed > stats.bytesBudget) cell.note = "over the budget";
  }

  StressCell cellOf(const Shot& shot, Integrator rule) const {
    StressCell cell;
    cell.group = "pictures", cell.axis = shot.axis, cell.value = shot.value, cell.variant = shot.variant;
    cell.integrator = kIntegratorNames[std::size_t(rule)];
    cell.limit = kStressLimit;
    return cell;
  }

  // Greatest optical depth of a step: of the coarsest node that this view may sample, at its greatest density.
  double depthPerStep(const Shot& shot, double sampleDetail) const {
    const double extinction = std::get<SlabSource>(stage.scene.clouds->sources.front()).extinction_per_m;
    const double top = std::get<SlabSource>(stage.scene.clouds->sources.front()).top_m, r = stage.scene.planet.radius_m;
    const double h = glm::length(shot.view.position_m) - r;
    const double far = std::sqrt(h * (2 * r + h)) + std::sqrt(top * (2 * r + top));  // the farthest cloud in sight
    const RootFrame root = RootFrame::enclosing(r, 20'000);
    const double node = std::max(2 * far / std::max(sampleDetail, 1e-3), root.nodeSize_m(std::uint32_t(stage.scene.quality.depth)));
    return extinction * stage.scene.quality.step * 0.5 * node / shared::kLeastCount;
  }

  void drawPath(const Shot& shot) {
    StressCell cell = cellOf(shot, stage.scene.quality.integrator);
    for (const View& view : shot.path) count(view, renderer.frame(view, FrameMode::Reprojected, shot.sinceLast_s), cell);
    cells.push_back(std::move(cell));
  }

  void draw(const Shot& shot) {
    const Scene& scene = stage.scene;
    const FrameStats settled = renderer.settle(shot.view);
    Judged judged;
    if (!stage.everyIntegrator) {
      StressCell cell = cellOf(shot, scene.quality.integrator);
      count(shot.view, renderer.frame(shot.view, FrameMode::Full), cell);
      const ImageF image = renderer.radiance();
      const Camera c = cameraOf(shot.view, scene.planet.radius_m, image.width, image.height);
      if (shot.truth == ShotTruth::Ground) judgeGround(scene, c, image, judged);
      if (shot.truth == ShotTruth::SlabOpacity) judgeSlab(scene, c, image, judged);
      if (shot.truth == ShotTruth::SingleOrder) judgeAir(scene, c, image, judged);
      if (judged.any) cell.relativeError = judged.worst;
      cells.push_back(std::move(cell));
      return;
    }
    Quality quality = scene.quality;
    quality.step /= 32;
    ImageF fine;
    for (int i = -1; i < int(kIntegratorNames.size()); ++i) {
      if (i >= 0) quality = scene.quality, quality.integrator = Integrator(i);
      StressCell cell = cellOf(shot, quality.integrator);
      if (const auto set = renderer.setMarch(quality); !set) {
        cell.note = set.error().message;
        cells.push_back(std::move(cell));
        continue;
      }
      const FrameStats stats = renderer.frame(shot.view, FrameMode::Full);
      if (i < 0) {
        fine = renderer.radiance();
        continue;
      }
      count(shot.view, stats, cell);
      judged = {};
      if (shot.truth == ShotTruth::FineMarch) judgeMarch(renderer.radiance(), fine, judged);
      if (judged.any) cell.relativeError = judged.worst;
      cell.limit = kMarchLimit;
      cell.depthPerStep = depthPerStep(shot, settled.sampleDetail);
      cell.predictedError = predictedExcess(quality.integrator, *cell.depthPerStep);
      if (quality.integrator == Integrator::ExponentialConstant) {
        // Its light comes from the middle of the step, and that of a cloud falls by e in four optical depths or fewer (sunSource).
        const double x = *cell.depthPerStep;
        cell.predictedError = -std::expm1(-0.25 * x * (0.5 - shared::emissionDepth(float(x))));
      }
      cell.predictedFail = cell.predictedError > cell.limit;
      cells.push_back(std::move(cell));
    }
  }
};

}  // namespace

Result<std::vector<StressCell>> stressPictures(gpu::Context& context, const StressSettings& settings, const StressProgress& progress) {
  std::deque<ShotStage> stages = stressStages(settings.quick);
  std::vector<StressCell> cells;
  double done = 0;
  for (ShotStage& stage : stages) {
    if (progress && !progress(done++ / double(stages.size()))) return Error{"stopped before the matrix was whole"};
    if (stage.leastBudget) {
      const auto least = leastBudget(context, stage.scene);
      if (!least) return least.error();
      stage.scene.quality.budget_bytes = *least;
    }
    auto renderer = Renderer::create(context, stage.scene, {.width = stage.width, .height = stage.height, .timing = false});
    for (const Shot& shot : stage.shots) {
      if (!renderer) {
        StressCell cell;
        cell.group = "pictures", cell.axis = shot.axis, cell.value = shot.value, cell.variant = shot.variant, cell.limit = kStressLimit;
        cell.integrator = kIntegratorNames[std::size_t(stage.scene.quality.integrator)];
        cell.note = renderer.error().message;
        cells.push_back(std::move(cell));
        continue;
      }
      Studio studio{stage, **renderer, cells};
      if (shot.path.empty()) {
        studio.draw(shot);
      } else {
        studio.drawPath(shot);
      }
    }
  }
  if (progress) progress(1);
  return cells;
}

}  // namespace welkin::measure
