// Draws the pictures of the stability matrix with the renderer itself and holds every pixel to its bounds and, where there is one, a truth.
#include <algorithm>
#include <cmath>

#include "stress_judges.h"
#include "stress_shots.h"
#include "welkin/clouds/density_source.h"
#include "welkin/measure/stress.h"
#include "welkin/physics/root_frame.h"
#include "welkin/render/renderer.h"
#include "welkin/shared/cloud_light.glsl.h"
#include "welkin/shared/step_rules.glsl.h"

namespace welkin::measure {
namespace {

// Of a march against its own at a 32nd of the step. The default step is chosen for the Earth's clouds, of which it shows an RMSE below 1 %;
// in the first voxel of a cloud that is as hard as a wall it may be off by more, as long as it stays in bounds.
constexpr double kMarchLimit = 0.1;

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
        // Its light comes from the middle of the step, and that of a cloud falls by e in three optical depths or more (sunSource: kSimilar).
        const double x = *cell.depthPerStep;
        cell.predictedError = -std::expm1(-double(shared::kSimilar) * x * (0.5 - shared::emissionDepth(float(x))));
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
