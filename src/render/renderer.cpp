#include "welkin/physics/air.h"
#include "welkin/render/renderer.h"

#include <fmt/format.h>

#include <cmath>
#include <deque>
#include <future>
#include <limits>

#include "render/bricks/brick_passes.h"
#include "render/debug/debug_pass.h"
#include "render/march/cloud_passes.h"
#include "render/albedo_picture.h"
#include "render/tree/resident_tree.h"
#include "welkin/clouds/opaque_deck.h"
#include "welkin/physics/scene_time.h"
#include "welkin/render/composite/composite_pass.h"
#include "welkin/render/exposure/exposure_pass.h"
#include "welkin/render/sky/sky_tables.h"
#include "welkin/shared/counters.glsl.h"

#include "welkin/shared/bindings.glsl.h"

namespace welkin {
namespace {

constexpr std::uint64_t kLatency = 2;            // edits computed from frame k are applied at frame k + 2
constexpr double kVoxelPixels = 0.78;            // finer is noise; at 180 lines this keeps K inside the octree maps (kMapReach)
constexpr std::uint32_t kSettleBricks = 8192;    // bricks of one step while settling: nothing is drawn in between
constexpr int kMostSettleSteps = 4000;           // far over the count a tree of the largest budget needs
constexpr int kRound = 16;                       // frames until every pixel was marched
constexpr std::uint64_t kSmallBuffers = 4096;    // camera block, counters and their alignment

// A voxel is node / 7: at the far end of its level's range it is kVoxelPixels wide, at the near end twice that.
double pixelDetail(const ViewFrame& view, int height) { return height / (2 * view.tanY * 7 * kVoxelPixels); }

// most: nodes a radian that are sampled at most; 0: as many as pixels show.
SelectionCamera selectionCamera(const ViewFrame& view, int height, double most) {
  const double pixels = pixelDetail(view, height);
  return {view.position_m, view.forward, view.right, view.up, view.tanY, view.tanX, most > 0 ? std::min(pixels, most) : pixels};
}

std::uint64_t treeBudget(const Scene& scene, const gpu::MemoryAccount& account, std::uint64_t brickPassBytes) {
  const std::uint64_t taken = account.used() + brickPassBytes + kSmallBuffers;
  return scene.quality.budget_bytes > taken ? scene.quality.budget_bytes - taken : 0;
}

}  // namespace

struct Renderer::Impl {
  Impl(gpu::Context& c, const Scene& s, const RenderSettings& r)
      : context(c), given(sceneFor(s, r.forced)), settings(r), wind_rad(windTurn_rad(given, r.time_s)), scene(inClouds(given)),
        plan(planFrame(inClouds(s), planFor())), account(s.quality.budget_bytes), timer(c.device().software) {
    timer.enabled = r.timing;
  }

  gpu::Context& context;
  Scene given;  // at its time 0, in the planet's frame
  RenderSettings settings;
  // All is drawn in the frame in which the clouds rest: the planet's, turned by their mean wind. Air is the same all around; only the
  // ground's picture knows of it.
  double wind_rad;  // eastwards
  Scene scene;      // as given, with the sun where it stands now in that frame
  FramePlan plan;
  gpu::MemoryAccount account;   // outlives everything charged to it
  gpu::PassTimer timer;
  gpu::Buffer camera, counters;
  std::optional<SkyTables> sky;
  struct NextSky {
    SkyTables tables;
    Scene scene;  // with the air that they are of
  };
  std::optional<NextSky> nextSky;  // in the making, after setAir()
  std::optional<CompositePass> composite;
  std::optional<ExposurePass> exposure;
  std::unique_ptr<DensitySource> source;
  RootFrame root;
  std::optional<ResidentTree> tree;
  std::optional<BrickPasses> bricks;
  std::optional<CloudPasses> clouds;
  std::optional<DebugPass> debug;
  bool debugDrawn = false;  // of the last picture; not where the background was all of it
  std::unique_ptr<Streamer> streamer;
  std::deque<std::uint64_t> asked;   // frames whose edits are not taken yet
  FrameEdits last;                   // the newest applied edits, without their lists
  std::uint64_t frameNumber = 0;
  std::uint64_t step = 0;            // number of the next input to the worker

  std::vector<std::string> notes;

  PlanFor planFor() const {
    const std::optional<View> view = settings.onlyView ? std::optional(turned(*settings.onlyView, -wind_rad)) : std::nullopt;
    return {view, view.has_value(), settings.linear, double(settings.width) / settings.height, settings.forced};
  }
  Scene inClouds(Scene out) const {
    if (out.sun) out.sun->direction_planet = turned(sunAt(*out.sun, settings.time_s), -wind_rad);
    return out;
  }
  void placeSun();
  Result<void> create();
  void note(std::string line) { notes.push_back(std::move(line)); }
  double shellTop_m() const { return plan.air ? airTop_m(scene) : source ? std::max(source->top_m(), 1.0) : 1.0; }
  void ask(const ViewFrame& view, std::uint32_t maxBricks, bool snap);
  void apply(FrameEdits&& edits, glm::dvec3 camera_planet, FrameStats& stats, bool lightNow = true);
  float greatestDetail = 1e6f;      // of this picture's pixels
  bool sunMoved = false;            // since the last frame
  bool away = false;                // the last frame was drawn bare: nothing is streamed since
  std::optional<View> shown;        // of the last frame
  std::uint64_t shownNan = 0;
  std::uint64_t stillFrames = 0;    // of the same view and tree
  int marchedFrames = 0;            // of the same, each a sixteenth of the pixels
  void updateTreeBlock(glm::dvec3 camera_planet);
  void workOnSky();
  void useAir(const Scene& changed);
  Result<void> setAir(const Scene& changed, AirChange how);
  ViewFrame frameOf(const View& view) const {
    return viewFrame(turned(view, -wind_rad), scene.planet.radius_m, shellTop_m(), settings.width, settings.height);
  }
  FrameCounters counted() const;  // since beginPicture()
  void drawAside(const View& view, const std::function<void()>& march);  // a picture that leaves history, tree and exposure alone
  void beginPicture(const ViewFrame& frame, bool bare = false);  // camera, counters, sky
  // Composite and exposure. sinceLast_s: ExposurePass::meter; none: the exposure stays where it is, unless there is none yet.
  void endPicture(const ViewFrame& frame, const View& view, std::optional<double> sinceLast_s, bool bare = false);
  Result<void> useDebugView(DebugView view);
  void drawDebug(const ViewFrame& frame, const View& view, glm::ivec2 turn);
  bool bareNow(const View& view, FrameStats& stats);
  void catchUp(const ViewFrame& frame, FrameStats& stats);
  bool asBefore(const View& view) const;
  bool shownView(const View& view) const;
  void remember(const View& view, const FrameStats& stats, bool treeChanged);
  double shown_ev(const View& view) const;
  std::optional<double> seen_ev(const View& view) const;  // the same, where it is known before the picture is drawn
  FrameStats report(FrameStats stats) const;
};

Result<void> Renderer::Impl::create() {
  auto cameraBuffer = gpu::Buffer::create(account, "camera block", sizeof(shared::CameraBlock));
  if (!cameraBuffer) return cameraBuffer.error();
  camera = std::move(*cameraBuffer);
  auto counterBuffer = gpu::Buffer::create(account, "counters", sizeof(shared::Counters));
  if (!counterBuffer) return counterBuffer.error();
  counters = std::move(*counterBuffer);
  // The source reads and resamples its cover picture while the tables are made and the ground's picture is read.
  std::future<Result<std::unique_ptr<DensitySource>>> sourceMade;
  if (plan.clouds) {
    root = RootFrame::enclosing(scene.planet.radius_m, kCloudShell_m);
    sourceMade = std::async(std::launch::async, [this] { return makeDensitySource(scene, root); });
  }
  if (plan.air) {
    auto tables = SkyTables::create(account, scene, SkyOrders::All, plan.everyHarmonic);
    if (!tables) return tables.error();
    if (!plan.sunMayMove) tables->letGoOfMakers();
    sky.emplace(std::move(*tables));
  }
  AlbedoPicture albedo;
  if (plan.albedoMap && !scene.planet.albedoMap.empty()) {
    auto picture = loadAlbedoPicture(scene);
    if (!picture) note(picture.error().message + ": the ground is plain");
    else albedo = std::move(*picture);
  }
  auto compositePass = CompositePass::create(account, scene, CompositeParts(plan), settings.width, settings.height, albedo.width ? &albedo : nullptr);
  if (!compositePass) return compositePass.error();
  composite.emplace(std::move(*compositePass));
  composite->use(scene, wind_rad);
  if (plan.metered) {
    auto exposurePass = ExposurePass::create(account, scene);
    if (!exposurePass) return exposurePass.error();
    exposure.emplace(std::move(*exposurePass));
  }
  if (!plan.clouds) return {};

  auto made = sourceMade.get();
  if (!made) return made.error();
  source = std::move(*made);
  if (!source->note().empty()) note(source->note());
  const TreeLayout layout = TreeLayout::fit(treeBudget(scene, account, BrickPasses::bytes(*source)), std::uint32_t(scene.quality.depth), settings.brickBits);
  if (layout.bricks == 0) {
    const std::uint64_t least = account.used() + BrickPasses::bytes(*source) + kSmallBuffers + TreeLayout::leastBytes(std::uint32_t(scene.quality.depth));
    return Error{fmt::format("budget: {} MiB is too little for this scene at depth {}: the least that works is {} MiB",
                             scene.quality.budget_bytes >> 20, scene.quality.depth, (least + (1 << 20) - 1) >> 20)};
  }
  auto residentTree = ResidentTree::create(account, layout, root);
  if (!residentTree) return residentTree.error();
  tree.emplace(std::move(*residentTree));
  auto brickPasses = BrickPasses::create(account, *source, *tree, plan, settings.light);
  if (!brickPasses) return brickPasses.error();
  bricks.emplace(std::move(*brickPasses));
  auto cloudPasses = CloudPasses::create(account, *tree, settings.width, settings.height, plan, scene.quality);
  if (!cloudPasses) return cloudPasses.error();
  clouds.emplace(std::move(*cloudPasses));
  StreamSettings stream;
  stream.depth = layout.depth;
  stream.brickCapacity = layout.bricks;
  stream.groupCapacity = layout.groups;
  stream.detailLimit = scene.quality.detail;
  if (!settings.forced.contains("overcast")) stream.deck = opaqueDeck(scene);
  streamer = std::make_unique<Streamer>(*source, root, stream, settings.workerJitterSeed);
  updateTreeBlock({0, 0, 0});
  return {};
}

void Renderer::Impl::updateTreeBlock(glm::dvec3 camera_planet) {
  shared::TreeBlock block{};
  const glm::dvec3 sun = scene.sun ? scene.sun->direction_planet : glm::dvec3(0, 0, 1);
  block.sunDir = glm::vec4(glm::vec3(sun), plan.sun ? 1.0f : 0.0f);
  block.mapCentre = glm::vec4(glm::vec3(camera_planet), 0.0f);
  block.detail = std::min(last.sampleDetail, greatestDetail);
  if (scene.quality.detail > 0) block.detail = std::min(block.detail, static_cast<float>(scene.quality.detail));
  block.pixelDetail = greatestDetail;
  block.cloudTop_m = static_cast<float>(source->top_m());
  block.maxExtinction_per_m = source->maxExtinction();
  block.bandBase_m = last.bandBase_m;
  block.shadowTop_m = std::max(last.bandTop_m, static_cast<float>(source->top_m()));
  block.sampleNear_m = last.sampleNear_m;
  block.bandTop_m = last.bandTop_m;
  block.step = static_cast<float>(scene.quality.step);
  tree->updateBlock(block);
}

void Renderer::Impl::ask(const ViewFrame& view, std::uint32_t maxBricks, bool snap) {
  FrameInput input;
  input.frame = step;
  input.camera = selectionCamera(view, settings.height, scene.quality.detail);
  input.maxBricks = maxBricks;
  input.detailLimit = settings.spareDetail * pixelDetail(view, settings.height);
  input.snap = snap;
  if (plan.sun && scene.sun) input.toSun = scene.sun->direction_planet;
  input.results = bricks->results(step >= kLatency && !snap ? step - kLatency : step);
  asked.push_back(step++);
  streamer->post(std::move(input));
}

void Renderer::Impl::apply(FrameEdits&& edits, glm::dvec3 camera_planet, FrameStats& stats, bool lightNow) {
  timer.begin("maps");
  tree->store(edits);
  last = std::move(edits);
  updateTreeBlock(camera_planet);
  tree->updateMaps(camera_planet);
  timer.end();
  stats.bricksLit += static_cast<std::uint32_t>(last.light.size());
  if (plan.sun && lightNow && !last.light.empty()) {
    timer.begin("light");
    bricks->light(*tree, last.light);
    timer.end();
  }
}

void Renderer::Impl::beginPicture(const ViewFrame& frame, bool bare) {
  greatestDetail = static_cast<float>(pixelDetail(frame, settings.height));
  camera.upload(0, std::as_bytes(std::span(&frame.block, 1)));
  camera.bind(GL_UNIFORM_BUFFER, WK_CAMERA_BINDING);
  counters.clear();
  counters.bind(GL_SHADER_STORAGE_BUFFER, WK_COUNTERS_BINDING);
  if (!sky) return;
  timer.begin("sky");
  workOnSky();
  if (!bare) sky->updateView(frame.block, scene.sun ? scene.sun->direction_planet : glm::dvec3(0, 0, 1));
  sky->bind();
  timer.end();
}

void Renderer::Impl::workOnSky() {
  if (!nextSky) return;
  const double start = gpu::wall_ms();
  bool more = true;
  do {
    more = nextSky->tables.advance(1);
    glFinish();  // else slices would pile up in the driver unseen
  } while (more && gpu::wall_ms() - start < settings.sky_ms);
  if (more) return;
  if (!plan.sunMayMove) nextSky->tables.letGoOfMakers();
  sky = std::move(nextSky->tables);
  useAir(nextSky->scene);
  nextSky.reset();
}

void Renderer::Impl::useAir(const Scene& changed) {
  given.planet.albedo = changed.planet.albedo, given.atmosphere = changed.atmosphere, given.sun = changed.sun;
  if (given.clouds && changed.clouds) given.clouds->windEast_m_per_s = changed.clouds->windEast_m_per_s;
  wind_rad = windTurn_rad(given, settings.time_s);
  scene.planet.albedo = given.planet.albedo, scene.atmosphere = given.atmosphere;
  const glm::dvec3 before = scene.sun ? scene.sun->direction_planet : glm::dvec3(0);
  scene.sun = given.sun;
  if (scene.sun) scene.sun->direction_planet = before;
  placeSun();
}

void Renderer::Impl::placeSun() {
  if (given.sun) {
    const glm::dvec3 now = turned(sunAt(*given.sun, settings.time_s), -wind_rad);
    sunMoved |= now != std::exchange(scene.sun->direction_planet, now);
  }
  composite->use(scene, wind_rad);
  stillFrames = 0, marchedFrames = 0;
}

Result<void> Renderer::Impl::setAir(const Scene& changed, AirChange how) {
  const Scene& latest = nextSky ? nextSky->scene : given;
  Scene next = latest;
  next.planet.albedo = changed.planet.albedo;
  next.atmosphere = changed.atmosphere;
  next.sun = changed.sun;
  if (next.clouds && changed.clouds) next.clouds->windEast_m_per_s = changed.clouds->windEast_m_per_s;
  const FramePlan nextPlan = planFrame(next, planFor());
  if (nextPlan.air != plan.air || nextPlan.sun != plan.sun) return Error{"air or a sun that come or go need a new start"};
  const bool sameSun = !next.sun || (latest.sun && next.sun->irradiance == latest.sun->irradiance &&
                                     next.sun->angularRadius_rad == latest.sun->angularRadius_rad);
  // Tables are for any place of the sun.
  if (sky && !(sameSun && next.planet.albedo == latest.planet.albedo && next.atmosphere == latest.atmosphere)) {
    auto tables = how == AirChange::Keep ? SkyTables::withField(account, next, *sky, plan.everyHarmonic)
                                         : SkyTables::begin(account, next, SkyOrders::All, plan.everyHarmonic);
    if (!tables) return tables.error();
    nextSky.reset();
    if (how == AirChange::Recompute)
      nextSky.emplace(NextSky{std::move(*tables), next});
    else
      sky = std::move(*tables);
  }
  if (nextSky) {  // the sun goes before its new light
    nextSky->scene.sun = changed.sun, nextSky->scene.clouds = next.clouds;
    next = given, next.clouds = nextSky->scene.clouds;
    if (next.sun) next.sun->direction_planet = changed.sun->direction_planet, next.sun->day_s = changed.sun->day_s;
  }
  useAir(next);
  return {};
}

void Renderer::Impl::endPicture(const ViewFrame& frame, const View& view, std::optional<double> sinceLast_s, bool bare) {
  const std::optional<double> fixed_ev = view.exposure_ev ? view.exposure_ev : scene.output.exposure_ev;
  timer.begin("composite");
  if (bare) composite->runBare(frame.block, fixed_ev.value_or(0));
  else composite->run(frame.block, fixed_ev.value_or(0));
  timer.end();
  if (!exposure) return;
  timer.begin("exposure");
  if (!view.exposure_ev && (sinceLast_s || !exposure->metered()))
    exposure->meter(composite->radiance(), sinceLast_s.value_or(std::numeric_limits<double>::infinity()));
  exposure->show(composite->radiance(), composite->display(), fixed_ev);
  timer.end();
}

Result<void> Renderer::Impl::useDebugView(DebugView view) {
  std::optional<DebugPass> next;
  if (view != DebugView::None) {
    auto made = DebugPass::create(account, view, clouds ? &*clouds : nullptr, *composite, scene.quality, settings.width, settings.height);
    if (!made) return made.error();
    next.emplace(std::move(*made));
  }
  debug.reset();
  if (next) debug.emplace(std::move(*next));
  stillFrames = 0, marchedFrames = 0, debugDrawn = false;
  return {};
}

void Renderer::Impl::drawDebug(const ViewFrame& frame, const View& view, glm::ivec2 turn) {
  timer.begin("debug");
  debug->draw(clouds ? &*clouds : nullptr, *composite, frame.block, shown_ev(view), turn);
  timer.end();
  debugDrawn = true;
}

double Renderer::Impl::shown_ev(const View& view) const { return seen_ev(view).value_or(exposure ? exposure->reached_ev() : 0); }

std::optional<double> Renderer::Impl::seen_ev(const View& view) const {
  if (view.exposure_ev) return *view.exposure_ev;
  if (scene.output.exposure_ev) return *scene.output.exposure_ev;
  if (exposure && exposure->metered()) return exposure->reached_ev();
  return {};
}

FrameStats Renderer::Impl::report(FrameStats stats) const {
  stats.residency = last.stats;
  stats.sampleDetail = last.sampleDetail;
  stats.bytesUsed = account.used();
  stats.bytesBudget = account.budget();
  stats.frameTargetBytes = account.frameTargets();
  if (plan.clouds && !away && plan.sun && scene.sun && last.oldestSun != glm::dvec3(0))
    stats.lightStale_deg = glm::degrees(2 * std::asin(std::min(glm::length(last.oldestSun - scene.sun->direction_planet) / 2, 1.0)));
  stats.skyProgress = nextSky ? nextSky->tables.progress() : 1;
  return stats;
}

Renderer::Renderer() = default;
Renderer::~Renderer() {
  impl_.reset();
  gpu::Context::letGo();
}

Result<std::unique_ptr<Renderer>> Renderer::create(gpu::Context& context, const Scene& scene, const RenderSettings& settings) {
  auto renderer = std::unique_ptr<Renderer>(new Renderer);
  renderer->impl_ = std::make_unique<Impl>(context, scene, settings);
  if (auto made = renderer->impl_->create(); !made) return made.error();
  return renderer;
}

// Is nothing but the background seen? Then the rest of the frame is left out.
bool Renderer::Impl::bareNow(const View& view, FrameStats& stats) {
  if (!plan.air && !plan.clouds) return false;
  PlanFor now = planFor();
  now.view = turned(view, -wind_rad);
  const auto unseen = nothingSeen(scene, now);
  if (!unseen || !composite->prepareBare()) return false;
  stats.leftOut = unseen->name;
  return true;
}

// Nothing was streamed for a while, and the camera may be anywhere: what is on its way is applied, and the tree's answer for here is
// waited for, as after a cut.
void Renderer::Impl::catchUp(const ViewFrame& frame, FrameStats& stats) {
  for (bool here = false; !here || !asked.empty();) {
    if (asked.empty()) ask(frame, settings.bricksPerFrame, true), here = true;
    FrameEdits edits = streamer->take(asked.front());
    asked.pop_front();
    const std::vector<BrickJob> generate = std::move(edits.generate);
    apply(std::move(edits), frame.position_m, stats);
    bricks->generate(*tree, generate, step);
    stats.bricksGenerated += static_cast<std::uint32_t>(generate.size());
  }
  clouds->forget();
}

// Would this frame be the last one again? Once every pixel was marched in a tree that rests, and edits on their way had the time to come,
// marching it again changes nothing.
bool Renderer::Impl::asBefore(const View& view) const {
  return !plan.redraw && !exposure && !nextSky && shownView(view) && stillFrames > kLatency && marchedFrames >= kRound;
}

bool Renderer::Impl::shownView(const View& view) const {
  return shown && view.position_m == shown->position_m && view.orientation == shown->orientation && view.fov_deg == shown->fov_deg &&
         view.exposure_ev == shown->exposure_ev;
}

void Renderer::Impl::remember(const View& view, const FrameStats& stats, bool treeChanged) {
  const bool still = shownView(view) && !treeChanged && (!plan.clouds || last.stats.settled || away);
  const bool all = !plan.clouds || away || stats.counters.marchedPixels == std::uint64_t(settings.width) * std::uint64_t(settings.height);
  stillFrames = still ? stillFrames + 1 : 0;
  marchedFrames = all ? kRound : still ? marchedFrames + 1 : 0;
  shown = view;
  shownNan = stats.counters.nanPixels;
}

FrameStats Renderer::frame(const View& view, FrameMode mode, double sinceLast_s) {
  Impl& r = *impl_;
  FrameStats stats;
  stats.frame = r.frameNumber++;
  if (mode == FrameMode::Reprojected && r.asBefore(view)) {
    stats.leftOut = "nothing-moves";
    stats.counters.nanPixels = r.shownNan;
    stats.exposure_ev = r.shown_ev(view);
    return r.report(stats);
  }
  const double wall0 = gpu::wall_ms(), cpu0 = gpu::processCpu_ms();
  const ViewFrame frame = r.frameOf(view);
  if (!r.settings.reprojection) mode = FrameMode::Full;

  FrameEdits edits;
  bool haveEdits = false, treeChanged = false;
  const bool bare = r.bareNow(view, stats), back = r.plan.clouds && r.away && !bare;
  r.away = bare;
  if (back) r.catchUp(frame, stats), treeChanged = true;
  if (r.plan.clouds && !bare && !back) {
    const bool due = r.asked.size() >= kLatency;
    if (due && (r.settings.waitForEdits || r.streamer->ready(r.asked.front()))) {
      const double waitFrom = gpu::wall_ms();
      edits = r.streamer->take(r.asked.front());
      stats.wait_ms = gpu::wall_ms() - waitFrom;
      r.asked.pop_front();
      haveEdits = true;
      treeChanged = !edits.nodes.empty() || !edits.dirty.empty() || !edits.light.empty() || !edits.generate.empty();
    }
  }
  r.beginPicture(frame, bare);
  if (r.plan.clouds && !bare) {
    std::vector<BrickJob> generate;
    if (haveEdits) {
      generate = std::move(edits.generate);
      r.apply(std::move(edits), frame.position_m, stats);
    } else {
      FrameEdits nothing = r.last;   // the camera moved: the maps follow
      nothing.nodes.clear();
      nothing.dirty.clear();
      nothing.light.clear();
      nothing.generate.clear();
      r.apply(std::move(nothing), frame.position_m, stats);
    }
    r.tree->bind();
    r.clouds->run(frame, mode, r.scene, r.seen_ev(view), std::exchange(r.sunMoved, false) || treeChanged || !r.last.stats.settled, r.timer);
    stats.bricksGenerated += static_cast<std::uint32_t>(generate.size());
    r.endPicture(frame, view, sinceLast_s);
    if (r.debug) r.drawDebug(frame, view, r.clouds->turn());
    r.timer.begin("bricks");
    r.bricks->generate(*r.tree, generate, r.step);
    r.timer.end();
    if (r.asked.size() < kLatency) r.ask(frame, r.settings.bricksPerFrame, false);
  } else {
    r.endPicture(frame, view, sinceLast_s, bare);
    r.debugDrawn = false;
    if (r.debug && !bare) r.drawDebug(frame, view, {-1, -1});
  }
  stats.counters = r.counted();
  stats.exposure_ev = r.shown_ev(view);  // the counters have been waited for: this is a copy
  r.remember(view, stats, treeChanged);
  stats.passes = r.timer.collect();
  stats.wall_ms = gpu::wall_ms() - wall0;
  stats.cpu_ms = gpu::processCpu_ms() - cpu0;
  return r.report(stats);
}

FrameStats Renderer::settle(const View& view, const std::function<bool(double)>& progress) {
  Impl& r = *impl_;
  FrameStats stats;
  r.stillFrames = 0;
  if (!r.plan.clouds || r.bareNow(view, stats)) return r.report(stats);
  r.away = false;
  const double wall0 = gpu::wall_ms(), cpu0 = gpu::processCpu_ms();
  const ViewFrame frame = r.frameOf(view);
  std::uint64_t made = 0;
  std::map<std::uint32_t, BrickJob> lit;
  int batches = 0;
  const std::uint64_t first = r.step;  // edits asked for before answer to another view: they are applied, but say nothing about this one
  bool stopped = false;  // what was asked for by then is still made, so that no frame finds it all at once
  for (int i = 0; i < kMostSettleSteps; ++i) {
    if (r.asked.empty() && stopped) break;
    if (r.asked.empty()) r.ask(frame, kSettleBricks, true);
    FrameEdits edits = r.streamer->take(r.asked.front());
    r.asked.pop_front();
    const std::vector<BrickJob> generate = std::move(edits.generate);
    r.apply(std::move(edits), frame.position_m, stats, r.plan.sunMayMove);
    batches += r.last.light.empty() ? 0 : 1;
    for (const BrickJob& job : r.last.light) lit[job.brick] = job;
    r.timer.begin("bricks");
    r.bricks->generate(*r.tree, generate, r.step);
    r.timer.end();
    made += generate.size();
    stats.bricksGenerated += static_cast<std::uint32_t>(generate.size());
    const double left = r.last.stats.pendingBricks;
    if (progress && !stopped) stopped = !progress(double(made) / std::max(1.0, double(made) + left));
    if (r.last.frame >= first && r.last.stats.settled && generate.empty() && r.asked.empty()) break;
  }
  // Light is made once all bricks are there, as nobody looks before. If it was made before, the first bricks' neighbours were still coarse.
  if (r.plan.sun && batches > (r.plan.sunMayMove ? 1 : 0)) {
    std::vector<BrickJob> all;
    for (const auto& [brick, job] : lit) all.push_back(job);
    if (!r.plan.sunMayMove) stats.bricksLit = std::uint32_t(all.size());
    r.timer.begin("light");
    r.bricks->light(*r.tree, all);
    r.timer.end();
  }
  if (!r.plan.sunMayMove && progress) progress(1);
  r.clouds->forget();
  stats.passes = r.timer.collect();
  stats.wall_ms = gpu::wall_ms() - wall0;
  stats.cpu_ms = gpu::processCpu_ms() - cpu0;
  return r.report(stats);
}

Result<void> Renderer::setAir(const Scene& changed, AirChange how) { return impl_->setAir(changed, how); }

void Renderer::setTime(double time_s) {
  Impl& r = *impl_;
  const double wind_rad = windTurn_rad(r.given, time_s);
  const bool moves = wind_rad != r.wind_rad || (r.given.sun && sunAt(*r.given.sun, time_s) != sunAt(*r.given.sun, r.settings.time_s));
  r.settings.time_s = time_s;
  r.wind_rad = wind_rad;
  if (moves) r.placeSun();
}

View Renderer::inClouds(const View& view) const { return turned(view, -impl_->wind_rad); }
glm::dvec3 Renderer::sunInClouds() const { return impl_->scene.sun ? impl_->scene.sun->direction_planet : glm::dvec3(0, 0, 1); }

Result<void> Renderer::setMarch(const Quality& quality) {
  Impl& r = *impl_;
  Quality next = r.scene.quality;
  next.integrator = quality.integrator, next.stepRule = quality.stepRule, next.skipEmpty = quality.skipEmpty;
  next.step = quality.step, next.detail = quality.detail, next.spread = quality.spread;
  if (r.clouds)
    if (auto used = r.clouds->use(r.account, next); !used) return used;
  const Quality was = std::exchange(r.scene.quality, next);
  r.given.quality = next;
  r.stillFrames = 0, r.marchedFrames = 0;
  const bool other = was.integrator != next.integrator || was.stepRule != next.stepRule || was.skipEmpty != next.skipEmpty;
  return r.debug && other ? r.useDebugView(r.debug->view()) : Result<void>{};
}

Result<void> Renderer::setOutput(const Output& output) {
  Impl& r = *impl_;
  Scene next = r.scene;
  next.output = output;
  const FramePlan plan = planFrame(next, r.planFor());
  std::optional<ExposurePass> exposure;
  if (plan.metered) {
    auto made = ExposurePass::create(r.account, next);
    if (!made) return made.error();
    exposure.emplace(std::move(*made));
  }
  if (plan.metered != r.plan.metered || output.toneCurve != r.scene.output.toneCurve)
    if (auto used = r.composite->useOutput(CompositeParts(plan), output.toneCurve); !used) return used;
  r.scene.output = r.given.output = output;
  r.plan = plan;
  r.exposure.reset();
  if (exposure) r.exposure.emplace(std::move(*exposure));
  r.stillFrames = 0, r.marchedFrames = 0;
  return r.debug ? r.useDebugView(r.debug->view()) : Result<void>{};  // its tone curve
}

void Renderer::setBricksPerFrame(std::uint32_t most) { impl_->settings.bricksPerFrame = most; }

Result<void> Renderer::resize(int width, int height) {
  Impl& r = *impl_;
  if (width == r.settings.width && height == r.settings.height) return {};
  r.settings.width = width, r.settings.height = height;
  r.shown.reset(), r.stillFrames = 0, r.marchedFrames = 0;
  if (auto made = r.composite->resize(width, height); !made) return made;
  if (r.clouds)
    if (auto made = r.clouds->resize(r.account, width, height); !made) return made;
  if (!r.debug) return {};
  auto made = r.debug->resize(r.account, width, height);
  if (!made) r.debug.reset(), r.debugDrawn = false;  // the picture itself goes on
  return made;
}

const gpu::Texture& Renderer::shown() const { return impl_->debugDrawn ? impl_->debug->picture() : impl_->composite->display(); }

Result<void> Renderer::setDebugView(DebugView view) { return impl_->useDebugView(view); }
DebugView Renderer::debugView() const { return impl_->debug ? impl_->debug->view() : DebugView::None; }
std::vector<float> Renderer::debugValues() const { return impl_->debugDrawn ? impl_->debug->values() : std::vector<float>{}; }

FrameCounters Renderer::preview(const View& view) {
  Impl& r = *impl_;
  r.drawAside(view, [&] { r.clouds->preview(r.scene, r.seen_ev(view)); });
  return r.counted();
}

Result<FrameCounters> Renderer::preview(const View& view, std::span<const glm::ivec2> pixels) {
  Impl& r = *impl_;
  Result<void> marched;
  r.drawAside(view, [&] { marched = r.clouds->preview(r.account, r.scene, pixels); });
  if (!marched) return marched.error();
  return r.counted();
}

FrameCounters Renderer::Impl::counted() const {
  shared::Counters c{};
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  counters.download(0, std::as_writable_bytes(std::span(&c, 1)));
  return {c.nanPixels, c.holes, c.marchedPixels, c.rejectedPixels, c.cells, c.samples};
}

void Renderer::Impl::drawAside(const View& view, const std::function<void()>& march) {
  const ViewFrame frame = frameOf(view);
  const bool timed = std::exchange(timer.enabled, false);
  stillFrames = 0;
  beginPicture(frame);
  if (plan.clouds) {
    updateTreeBlock(frame.position_m);
    tree->updateMaps(frame.position_m);
    tree->bind();
    march();
  }
  endPicture(frame, view, {});
  if (debug) drawDebug(frame, view, {-1, -1});
  timer.enabled = timed;
}

shared::CameraBlock Renderer::camera(const View& view) const { return impl_->frameOf(view).block; }

TreeData Renderer::tree(const View& view) {
  Impl& r = *impl_;
  if (!r.plan.clouds) return {};
  const ViewFrame frame = r.frameOf(view);
  r.greatestDetail = static_cast<float>(pixelDetail(frame, r.settings.height));
  r.updateTreeBlock(frame.position_m);
  return r.tree->readBack();
}

Result<void> Renderer::drawWith(const View& view, std::span<const shared::CloudWeights> clouds) {
  Impl& r = *impl_;
  if (r.plan.clouds && clouds.size() != std::size_t(r.settings.width) * std::size_t(r.settings.height))
    return Error{fmt::format("expected what the clouds bring for {} x {} pixels, got {}", r.settings.width, r.settings.height, clouds.size())};
  Result<void> shown;
  r.drawAside(view, [&] { shown = r.clouds->show(r.account, r.scene, clouds); });
  return shown;
}

double Renderer::drawnDetail(const View& view) const { return std::min(double(impl_->last.sampleDetail), shownDetail(view)); }

double Renderer::shownDetail(const View& view) const {
  const Impl& r = *impl_;
  return pixelDetail(viewFrame(view, r.scene.planet.radius_m, r.shellTop_m(), r.settings.width, r.settings.height), r.settings.height);
}

Image8 Renderer::image() const {
  Image8 image{impl_->settings.width, impl_->settings.height, {}};
  image.rgba.resize(std::size_t(image.width) * std::size_t(image.height) * 4);
  glGetTextureImage(shown().id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(image.rgba.size()), image.rgba.data());
  return image;
}

ImageF Renderer::radiance() const {
  ImageF image{impl_->settings.width, impl_->settings.height, {}};
  if (!impl_->plan.linear) return {};
  image.rgba.resize(std::size_t(image.width) * std::size_t(image.height) * 4);
  glGetTextureImage(impl_->composite->radiance().id(), 0, GL_RGBA, GL_FLOAT, GLsizei(image.rgba.size() * sizeof(float)), image.rgba.data());
  return image;
}

const FramePlan& Renderer::plan() const { return impl_->plan; }
const Scene& Renderer::scene() const { return impl_->given; }
const gpu::MemoryAccount& Renderer::memory() const { return impl_->account; }

std::vector<std::string> Renderer::notes() const {
  return impl_->notes;
}

Result<std::uint64_t> leastBudget(gpu::Context& context, const Scene& scene) {
  Scene plenty = scene;
  plenty.quality.budget_bytes = std::uint64_t{1} << 40;
  plenty.clouds.reset();
  plenty.planet.albedoMap.clear();
  auto renderer = Renderer::create(context, plenty, {.width = 16, .height = 16});
  if (!renderer) return renderer.error();
  std::uint64_t bytes = (*renderer)->memory().used() + kSmallBuffers;
  if (planFrame(scene).clouds) {
    auto source = makeDensitySource(scene, RootFrame::enclosing(scene.planet.radius_m, kCloudShell_m));
    if (!source) return source.error();
    bytes += BrickPasses::bytes(**source) + TreeLayout::leastBytes(std::uint32_t(scene.quality.depth));
  }
  const auto wholeMiB = [](std::uint64_t n) { return ((n + (1 << 20) - 1) >> 20) << 20; };
  std::uint64_t least = wholeMiB(bytes);
  if (scene.planet.albedoMap.empty()) return least;
  const auto albedo = loadAlbedoPicture(scene);
  if (!albedo) return least;  // the ground will be plain
  // The ground's picture takes what the budget gives it.
  for (;; least += 1 << 20) {
    int width = albedo->width, height = albedo->height;
    while (!CompositePass::albedoFits(width, height, least)) width = std::max(width / 2, 1), height = std::max(height / 2, 1);
    if (bytes + CompositePass::albedoBytes(width, height) <= least) return least;
  }
}

}  // namespace welkin
