#include "welkin/app/bench.h"

#include <fmt/format.h>
#include <glad/gl.h>

#include <nlohmann/json.hpp>

#include "idle.h"
#include "welkin/app/draw.h"
#include "welkin/app/stop.h"
#include "welkin/core/files.h"
#include "welkin/core/progress.h"
#include "welkin/core/units.h"
#include "welkin/gpu/timer.h"
#include "welkin/measure/image_compare.h"
#include "welkin/measure/statistics.h"

namespace welkin::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kFineStep = 1.0 / 32;  // of the scene's own: what the picture is compared with
constexpr double kCloudy = 0.5;         // opacity from which a pixel counts as cloud
constexpr double kSettled_255 = 1;      // RMSE on 0..255 that counts as the settled picture
constexpr int kStillFrames = 100;       // of a settled tree, in which nothing may be generated or lit
constexpr int kHistoryFrames = 16;      // one pixel in 16 a frame: until every pixel is marched

struct Series {  // many frames of one kind
  std::map<std::string, std::vector<double>> passCpu_ms, passWall_ms;
  std::vector<double> cpu_ms, wall_ms, passes_ms;
  FrameStats last;

  void add(const FrameStats& s) {
    double sum = 0;
    for (const auto& [name, time] : s.passes) {
      passCpu_ms[name].push_back(time.cpu_ms);
      passWall_ms[name].push_back(time.wall_ms);
      sum += time.cpu_ms;
    }
    cpu_ms.push_back(s.cpu_ms);
    wall_ms.push_back(s.wall_ms);
    passes_ms.push_back(sum);
    last = s;
  }
  static double median(const std::vector<double>& v) { return measure::summarize(v).median; }
  Json json(double pixels) const {
    Json out{{"frames", cpu_ms.size()}, {"cpu_ms", median(cpu_ms)}, {"wall_ms", median(wall_ms)}, {"passes_cpu_ms", median(passes_ms)}};
    for (const auto& [name, values] : passCpu_ms)
      out["passes"][name] = {{"cpu_ms", median(values)}, {"wall_ms", median(passWall_ms.at(name))}};
    const auto& c = last.counters;
    const double rays = std::max<double>(1, double(c.marchedPixels));
    out["marched_share"] = double(c.marchedPixels) / pixels;
    out["cells_per_ray"] = double(c.cells) / rays;
    out["samples_per_ray"] = double(c.samples) / rays;
    out["nan_pixels"] = c.nanPixels;
    out["holes"] = c.holes;
    return out;
  }
};

class Bench {
 public:
  Bench(const BenchOptions& options, Start start, Size size) : options_(options), start_(std::move(start)), size_(size) {
    settings_.width = size.width;
    settings_.height = size.height;
    settings_.time_s = start_.time_s;
    settings_.forced = {"nothing-moves"};  // a frame like the last one is what is measured
  }

  Result<void> run() {
    Progress progress("bench", options_.common.quiet);
    progress.update(0);
    auto stage = openStage(start_.scene, settings_, options_.common.gpu);
    if (!stage) return stage.error();
    stage_ = std::move(*stage);
    report_["context"] = context();
    if (auto done = settle(progress); !done) return done;
    frames(progress);
    if (auto done = quality(); !done) return done;
    if (options_.coldStart && !stopRequested()) {
      if (auto done = coldStart(progress); !done) return done;
    }
    progress.finish();
    if (stopRequested()) return Error{fmt::format("{}: stopped before all was measured", options_.scene.string())};
    report_["left_out"] = Json::array();
    for (const auto& [what, reason, name] : renderer().plan().leftOut)
      report_["left_out"].push_back({{"name", name}, {"what", what}, {"reason", reason}});
    report_["gl_debug_messages"] = stage_.context->debugMessages();
    if (!options_.common.json.empty()) {
      const auto text = report_.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
      if (auto written = writeFile(options_.common.json, text); !written) return written;
    }
    print();
    return {};
  }

 private:
  Renderer& renderer() const { return *stage_.renderer; }

  Json context() const {
    measure::TimingReport report;
    report.context = describeRun(start_.scene, size_);
    describeDevice(*stage_.context, report.context);
    auto out = Json::parse(report.json())["context"];
    out["view"] = start_.viewName;
    return out;
  }

  Result<void> settle(Progress& progress) {
    const auto s = renderer().settle(start_.view, [&](double f) {
      progress.update(0.4 * f, "settling");
      return !stopRequested();
    });
    if (stopRequested()) return Error{fmt::format("{}: stopped before the tree was settled", options_.scene.string())};
    report_["settle"] = {
        {"wall_ms", s.wall_ms}, {"cpu_ms", s.cpu_ms}, {"bricks_generated", s.bricksGenerated}, {"bricks_lit", s.bricksLit}};
    for (const auto& [name, time] : s.passes) report_["settle"]["passes"][name] = {{"cpu_ms", time.cpu_ms}, {"wall_ms", time.wall_ms}};
    return {};
  }

  Series series(FrameMode mode, int count) const {
    Series out;
    for (int i = 0; i < count && !stopRequested(); ++i) {
      waitUntilIdle();
      out.add(renderer().frame(start_.view, mode));
    }
    return out;
  }

  void frames(Progress& progress) {
    const double pixels = double(size_.width) * size_.height;
    series(FrameMode::Full, 2);  // the first frames compile shaders and apply the last edits
    progress.update(0.45, "full frames");
    const Series full = series(FrameMode::Full, options_.frames);
    report_["full"] = full.json(pixels);
    progress.update(0.6, "one pixel in 16");
    series(FrameMode::Reprojected, kHistoryFrames);
    const Series part = series(FrameMode::Reprojected, options_.frames);
    report_["sixteenth"] = part.json(pixels);
    stillImage_ = renderer().image();
    std::uint64_t generated = 0, lit = 0;
    for (int i = 0; i < kStillFrames && !stopRequested(); ++i) {
      const auto s = renderer().frame(start_.view);
      generated += s.bricksGenerated;
      lit += s.bricksLit;
    }
    report_["still"] = {{"frames", kStillFrames}, {"bricks_generated", generated}, {"bricks_lit", lit}};

    const auto& s = part.last;
    const auto& r = s.residency;
    int deepest = 0;
    Json levels = Json::array();
    for (int i = 0; i < int(std::size(r.bricksByLevel)); ++i) deepest = r.bricksByLevel[i] ? i : deepest;
    for (int i = 0; i <= deepest; ++i) levels.push_back(r.bricksByLevel[i]);
    report_["residency"] = {{"bricks", r.bricks},
                            {"brick_capacity", r.brickCapacity},
                            {"brick_fill", r.brickCapacity ? double(r.bricks) / r.brickCapacity : 0.0},
                            {"nodes", r.nodes},
                            {"empty", r.emptyNodes},
                            {"bricks_by_level", levels},
                            {"selected_detail", r.selectedDetail},
                            {"sample_detail", s.sampleDetail},
                            {"settled", r.settled},
                            {"bytes", s.bytesUsed},
                            {"budget", s.bytesBudget},
                            {"cpu_bytes", r.cpuBytes}};
  }

  // Every pixel marched as the scene says, against the same tree by the default rules at a thirty-second of the default step.
  Result<void> quality() {
    renderer().preview(start_.view);
    settledImage_ = renderer().image();
    const auto light = renderer().radiance();
    std::size_t cloudy = 0;
    for (std::size_t i = 3; i < light.rgba.size(); i += 4) cloudy += light.rgba[i] > kCloudy;
    Quality finest;
    finest.step *= kFineStep, finest.detail = start_.scene.quality.detail;
    if (auto used = renderer().setMarch(finest); !used) return used;
    renderer().preview(start_.view);
    const auto fine = measure::compare(renderer().image(), settledImage_);
    if (auto used = renderer().setMarch(start_.scene.quality); !used) return used;
    if (!fine) return fine.error();
    const auto still = measure::compare(settledImage_, stillImage_);
    if (!still) return still.error();
    report_["quality"] = {{"rmse_vs_fine_step", fine->rmse_255 / 255},
                          {"max_255_vs_fine_step", fine->max_255},
                          {"fine_step", finest.step},
                          {"cloudy_share", light.rgba.empty() ? 0.0 : 4.0 * double(cloudy) / double(light.rgba.size())},
                          {"still_rmse_255", still->rmse_255},
                          {"still_share_over_1", still->shareOver1}};
    return {};
  }

  // From nothing but an open GL to the settled picture; drawing the pictures in between does not count.
  Result<void> coldStart(Progress& progress) {
    stage_.renderer.reset();
    RenderSettings untimed = settings_;
    untimed.timing = false;
    untimed.forced.insert("sun-fixed");  // light as it comes, as in a window: who watches wants more than the last picture
    glFinish();
    const double wall0 = gpu::wall_ms(), cpu0 = gpu::processCpu_ms();
    double lookWall = 0, lookCpu = 0;  // of the pictures
    auto made = Renderer::create(*stage_.context, start_.scene, untimed);
    if (!made) return made.error();
    stage_.renderer = std::move(*made);
    glFinish();
    const double create_s = (gpu::wall_ms() - wall0) / 1000;
    Json curve = Json::array();
    Error failed;
    const auto look = [&](double f) {
      glFinish();
      const double w = gpu::wall_ms(), c = gpu::processCpu_ms();
      renderer().preview(start_.view);
      const auto error = measure::compare(settledImage_, renderer().image());
      if (!error) failed = error.error();
      const double wall_s = (w - wall0 - lookWall) / 1000, cpu_s = (c - cpu0 - lookCpu) / 1000;
      if (error) curve.push_back({{"wall_s", wall_s}, {"cpu_s", cpu_s}, {"rmse_255", error->rmse_255}});
      lookWall += gpu::wall_ms() - w;
      lookCpu += gpu::processCpu_ms() - c;
      progress.update(0.7 + 0.3 * f, "cold start");
      return error.ok() && !stopRequested();
    };
    renderer().settle(start_.view, look);
    if (!failed.message.empty()) return failed;
    Json& cold = report_["cold_start"] = {{"create_s", create_s}};
    for (std::size_t i = curve.size(); i-- > 0 && curve[i]["rmse_255"].get<double>() <= kSettled_255;) {  // from there on it stays
      cold["wall_s"] = curve[i]["wall_s"];
      cold["cpu_s"] = curve[i]["cpu_s"];
    }
    cold["curve"] = std::move(curve);
    return {};
  }

  void print() const {
    const auto& full = report_["full"];
    const auto& part = report_["sixteenth"];
    fmt::print("{:<12} {:>14} {:>14}\n", "CPU ms", "every pixel", "one in 16");
    const auto cell = [](const Json& of, const std::string& name) {
      return of.contains("passes") && of["passes"].contains(name) ? fmt::format("{:.2f}", of["passes"][name]["cpu_ms"].get<double>()) : "-";
    };
    for (const auto& pass : renderer().plan().passes) fmt::print("{:<12} {:>14} {:>14}\n", pass, cell(full, pass), cell(part, pass));
    fmt::print("{:<12} {:>14.2f} {:>14.2f}\n", "frame", full["cpu_ms"].get<double>(), part["cpu_ms"].get<double>());
    const auto& q = report_["quality"];
    const auto& r = report_["residency"];
    fmt::print("RMSE (0-1) against a step 32 times finer: {:.4f}\n", q["rmse_vs_fine_step"].get<double>());
    fmt::print("cloud opacity over 0.5: {:.0f} % of the pixels\n", 100 * q["cloudy_share"].get<double>());
    fmt::print("bricks: {} of {}, {:.0f} %\n", r["bricks"].get<std::uint64_t>(), r["brick_capacity"].get<std::uint64_t>(),
               100 * r["brick_fill"].get<double>());
    const auto& settle = report_["settle"];
    fmt::print("settled in {:.2f} s ({:.2f} s CPU), {} bricks\n", settle["wall_ms"].get<double>() / 1000,
               settle["cpu_ms"].get<double>() / 1000, settle["bricks_generated"].get<std::uint64_t>());
    if (report_.contains("cold_start") && report_["cold_start"].contains("wall_s")) {
      fmt::print("cold start to 1/255 of the settled picture: {:.2f} s ({:.2f} s CPU)\n", report_["cold_start"]["wall_s"].get<double>(),
                 report_["cold_start"]["cpu_s"].get<double>());
    }
  }

  const BenchOptions& options_;
  Start start_;
  Size size_;
  RenderSettings settings_;
  Stage stage_;
  Image8 settledImage_, stillImage_;
  Json report_;
};

}  // namespace

Result<void> bench(const BenchOptions& options) {
  auto start = loadStart(options.scene, options.view);
  if (!start) return start.error();
  apply(options.common, *start);
  if (!options.common.json.empty()) {
    if (auto writable = checkWritableFile(options.common.json); !writable) return writable;
  }
  listenForStop();
  const Size size = options.common.size.value_or(start->size);
  return Bench(options, std::move(*start), size).run();
}

}  // namespace welkin::app
