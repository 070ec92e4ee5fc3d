#include <algorithm>
#include <array>
#include <chrono>

#include "welkin/app/commands.h"
#include "welkin/app/checksum.h"
#include "welkin/app/draw.h"
#include "welkin/app/stop.h"
#include "welkin/core/files.h"
#include "welkin/core/progress.h"
#include "welkin/core/units.h"
#include "welkin/measure/tolerance.h"

namespace welkin::app {
namespace {

struct RenderOptions {
  CommonOptions common;
  std::filesystem::path input, output;
  std::string view;
  DebugView debug = DebugView::None;
};

Result<void> writeRendered(const RenderOptions& o, const Renderer& renderer, const PictureState& state) {
  const auto folder = o.output.has_parent_path() ? o.output.parent_path() : std::filesystem::path(".");
  const Texts texts = textsFromState(state, folder);
  return kindOfName(o.output) == PictureKind::Exr ? writeExr(o.output, renderer.radiance(), texts)
                                                  : writePng(o.output, renderer.image(), texts);
}

constexpr int kTimedFrames = 5;
constexpr int kRound = 16;  // frames until every pixel was marched

// The view in false colours, of the tree as it is. Ages are those of a picture at rest, when every pixel had its turn.
Result<FrameStats> drawDebug(const RenderOptions& o, Renderer& renderer, const View& view) {
  if (auto used = renderer.setDebugView(o.debug); !used) return used.error();
  FrameStats stats = renderer.frame(view, FrameMode::Full);
  for (int i = 0; o.debug == DebugView::History && i < kRound; ++i) stats = renderer.frame(view);
  return stats;
}

double medianTime_ms(Renderer& renderer, const View& view) {
  std::array<double, kTimedFrames> times;
  for (double& t : times) t = timePicture(renderer, view).wall_ms;
  std::nth_element(times.begin(), times.begin() + kTimedFrames / 2, times.end());
  return times[kTimedFrames / 2];
}

void printKept(const RenderOptions& o, const measure::KeptTolerance& kept) {
  const Quality& q = kept.choice.quality;
  fmt::print("tolerance {}: reached {:.2f} (RMSE, 0-255) with step {}, spread {}, detail {}{}\n", *o.common.tolerance_255, kept.reached_255, q.step, q.spread,
             q.detail > 0 ? fmt::format("{:.0f} nodes a radian", q.detail) : "of the pixels",
             kept.reached_255 <= *o.common.tolerance_255 ? "" : "; no finer march was tried");
}

Result<void> runRender(const RenderOptions& o) {
  beginCommand(o.common);
  if (o.debug != DebugView::None && kindOfName(o.output) == PictureKind::Exr)
    return Error{fmt::format("{}: expected a name that ends in .png for a picture in false colours", o.output.string())};
  const auto begin = std::chrono::steady_clock::now();
  auto start = loadStart(o.input, o.view);
  if (!start) return start.error();
  apply(o.common, *start);
  const Size size = o.common.size.value_or(start->size);
  if (auto writable = checkWritableFile(o.output); !writable) return writable;
  if (!o.common.json.empty()) {
    if (auto writable = checkWritableFile(o.common.json); !writable) return writable;
  }
  listenForStop();

  RenderSettings settings;
  settings.width = size.width;
  settings.height = size.height;
  settings.onlyView = start->view;
  settings.time_s = start->time_s;
  settings.linear = o.common.tolerance_255 || kindOfName(o.output) == PictureKind::Exr;
  if (o.debug == DebugView::History) settings.forced.insert("one-picture");
  auto stage = openStage(start->scene, settings, o.common.gpu);
  if (!stage) return stage.error();
  Progress progress("render", o.common.quiet);
  progress.update(0);
  auto stats = drawConverged(*stage->renderer, start->view, [&](double fraction) {
    progress.update(0.95 * fraction);  // the rest is the picture itself
    return !stopRequested();
  });
  if (!stats) return Error{fmt::format("{}: {}", o.output.string(), stats.error().message)};
  std::optional<measure::KeptTolerance> kept;
  if (o.common.tolerance_255) {
    progress.update(0.95, "picking the march");
    auto done = measure::keepTolerance(*stage->renderer, start->view, stats->exposure_ev, *o.common.tolerance_255);
    if (!done) return done.error();
    kept = *done;
    *stats = stage->renderer->frame(start->view, FrameMode::Full);
  }
  std::optional<DebugNumbers> debug;
  if (o.debug != DebugView::None) {
    auto drawn = drawDebug(o, *stage->renderer, start->view);
    if (!drawn) return drawn.error();
    *stats = *drawn;
    debug = debugNumbers(o.debug, stage->renderer->debugValues());
  }
  progress.update(1);
  progress.finish();

  const auto data = dataChecksums(start->scene);
  if (auto written =
          writeRendered(o, *stage->renderer, stateOf(*stage->renderer, start->view, stats->exposure_ev, size, start->time_s, true, data));
      !written)
    return written;
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!o.common.json.empty()) {
    measure::TimingReport report;
    report.name = "render";
    report.context = describeRun(start->scene, size);
    report.context.bricksPerFrame = settings.bricksPerFrame;
    describeDevice(*stage->context, report.context);
    report.frames.push_back(
        {0, start->time_s, glm::length(start->view.position_m) - start->scene.planet.radius_m, *stats, o.output.filename().string()});
    report.leftOut = stage->renderer->plan().leftOut;
    report.passOrder = stage->renderer->plan().passes;
    report.memoryByName = stage->renderer->memory().byName();
    report.notes = stage->renderer->notes();
    report.glMessages = stage->context->debugMessages();
    report.glFirstMessages = stage->context->firstMessages();
    if (kept) {
      report.tolerance_255 = o.common.tolerance_255;
      report.tolerance.push_back({0, kept->choice, kept->reached_255});
    }
    report.debug = debug;
    if (auto off = stage->renderer->setDebugView(DebugView::None); !off) return off;  // times are those of the picture
    report.time_ms = medianTime_ms(*stage->renderer, start->view);
    report.total_s = seconds;
    if (auto written = writeFile(o.common.json, report.json() + "\n"); !written) return written;
  }
  fmt::print("{}: {}x{}, {:.1f} s, {} bricks, {} of {}\n", o.output.string(), size.width, size.height, seconds, stats->residency.bricks,
             bytesText(stats->bytesUsed), bytesText(stats->bytesBudget));
  if (kept) printKept(o, *kept);
  if (debug) fmt::print("{}: {}\n", kDebugViewNames[std::size_t(o.debug)], debugText(*debug));
  return {};
}

}  // namespace

void addRender(CLI::App& app, Action& action) {
  auto o = std::make_shared<RenderOptions>();
  auto* command = app.add_subcommand("render", "draw one converged picture, then exit");
  command->footer(
      "Examples:\n  welkin render scenes/earth.json --view orbit --size 1280x720 -o orbit.png\n"
      "  welkin render orbit.png -o again.png      the same picture from the state that it carries");
  command->add_option("SCENE", o->input, "a scene (JSON), or a picture (PNG, EXR) of this program")->required();
  command->add_option("--view", o->view, "which view of the scene");
  command->add_option("-o,--output", o->output, "OUT.png (tone-mapped) or OUT.exr (linear, half)")
      ->required()
      ->check(
          [](const std::string& text) { return kindOfName(text) == PictureKind::None ? "expected a name that ends in .png or .exr" : ""; });
  addParsed<DebugView>(*command, "--debug", "a picture in false colours: " + namesText(kDebugViewNames), parseName<DebugView>(kDebugViewNames),
                       [o](DebugView v) { o->debug = v; });
  addQualityOptions(*command, o->common);
  addTimeOption(*command, o->common);
  addToleranceOption(*command, o->common);
  addOutputOptions(*command, o->common, "write times, residency and counters to this file");
  command->callback([o, &action] { action = [o] { return runRender(*o); }; });
}

}  // namespace welkin::app
