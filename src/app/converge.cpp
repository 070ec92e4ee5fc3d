#include "welkin/app/converge.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "converge_rows.h"
#include "converge_truth.h"
#include "idle.h"
#include "welkin/app/draw.h"
#include "welkin/app/flight.h"
#include "welkin/app/stop.h"
#include "welkin/core/files.h"
#include "welkin/core/log.h"
#include "welkin/core/progress.h"
#include "welkin/core/units.h"
#include "welkin/measure/flip.h"

namespace welkin::app {
namespace {

using measure::ConvergeSetting, measure::Frames;

constexpr int kHistoryFrames = 16;      // one pixel in 16 a frame: until every pixel is marched
constexpr double kTruthStep = 1 / 8.;   // of the finest step of the sweep,
constexpr double kTruthMost = 1 / 32.;  // and at most so much of the scene's own
constexpr double kRayTolerance = 1e-5;  // of a ray's weights, 1/sr: 0.03 of 255 in middle grey
constexpr int kSourceEvery = 8;         // a ray through the source costs a second

void keepOnly(std::vector<float>& values, const std::vector<std::uint32_t>& pixels) {
  std::vector<float> kept(values.size(), 0.0f);
  for (const std::uint32_t p : pixels) kept[p] = values[p];
  values = std::move(kept);
}

class Convergence {
 public:
  Convergence(const ConvergeOptions& options, Poses poses, std::vector<ConvergeSetting> settings)
      : options_(options), poses_(std::move(poses)), settings_(std::move(settings)) {}

  Result<void> run(Trees& trees, Progress& progress) {
    trees_ = &trees;
    progress_ = &progress;
    for (std::size_t i = 0; i < settings_.size();) {
      const auto opened = trees.open(settings_[i]);
      // A preset's smaller budgets may be less than the scene needs; what was asked for by name must work.
      if (!opened && (!options_.sweep.empty() || i == 0)) return opened;
      if (!opened) log::warn("{}: left out: {}", settings_[i].name, opened.error().message);
      if (opened)
        ++i;
      else
        settings_.erase(settings_.begin() + std::ptrdiff_t(i));
    }
    works_.resize(settings_.size());
    truth_ = truthSetting();
    if (auto made = trees.open(truth_); !made) return made;
    if (auto fixed = fixExposure(); !fixed) return fixed;
    for (std::size_t pose = 0; pose < poses_.views.size(); ++pose)
      if (auto done = measurePose(pose); !done) return done;
    return {};
  }

  measure::ConvergeReport report() {
    measure::ConvergeReport out;
    for (std::size_t i = 0; i < settings_.size(); ++i)
      out.rows.push_back(rowOf(settings_[i], works_[i], trees_->settled(settings_[i]), trees_->software()));
    addBest(out.rows, works_);
    out.view = poses_.name;
    out.poses = int(poses_.views.size());
    out.repetitions = options_.repetitions;
    out.clock = trees_->software() ? "CPU of the process, all cores added, of all passes of a frame" : "GPU, of all passes of a frame";
    out.truth.kind = kTruthNames[std::size_t(options_.truth)];
    out.truth.description = describeTruth(truthSettings());
    out.truth.tolerance_255 = measure::joined(truthErrors_).rmse_255;
    addPictures(out, works_, firstTruth_);
    return out;
  }

 private:
  // The finest tree of all, marched far finer than any setting.
  ConvergeSetting truthSetting() const {
    ConvergeSetting t = settings_.front();
    double step = poses_.scene.quality.step * kTruthMost;
    for (const auto& s : settings_) {
      t.quality.budget_bytes = std::max(t.quality.budget_bytes, s.quality.budget_bytes);
      t.quality.depth = std::max(t.quality.depth, s.quality.depth);
      t.light = std::max(t.light, s.light);
      t.brickBits = std::max(t.brickBits, s.brickBits);
      step = std::min(step, s.quality.step * kTruthStep);
    }
    t.quality.integrator = Integrator::ExponentialLinear;
    t.quality.stepRule = StepRule::Optical;
    t.quality.skipEmpty = true;
    t.quality.detail = 0;
    t.quality.spread = 0;
    t.quality.step = step;
    t.frames = Frames::Full;
    return t;
  }

  // A metered exposure would hide a part of the error: all pictures get that of the first pose's truth.
  Result<void> fixExposure() {
    const View& first = poses_.views.front();
    double ev = 0;
    if (poses_.scene.output.exposure_ev || first.exposure_ev) {
      ev = first.exposure_ev.value_or(poses_.scene.output.exposure_ev.value_or(0));
    } else {
      if (auto settled = trees_->settle(first, poses_.times_s.front(), [](double) { return !stopRequested(); }); !settled) return settled;
      ev = trees_->of(truth_).frame(first, FrameMode::Full).exposure_ev;
    }
    const auto fix = [ev](View& view) { view.exposure_ev = view.exposure_ev.value_or(ev); };
    for (auto& view : poses_.views) fix(view);
    for (auto& frames : poses_.before)
      for (auto& frame : frames) fix(frame.view);
    return {};
  }

  Result<void> measurePose(std::size_t pose) {
    const View& view = poses_.views[pose];
    ev_ = *view.exposure_ev;
    const double rounds = options_.repetitions + 2.0;
    for (const auto& s : settings_)  // light is made for the detail that is sampled: no setting's may be left
      if (auto used = trees_->of(s).setMarch(truth_.quality); !used) return used;
    const auto share = [&](double part) { return (double(pose) + part) / double(poses_.views.size()); };
    const auto settling = [&](double f) { return update(share(f / rounds), "settling"); };
    if (auto settled = trees_->settle(view, poses_.times_s[pose], settling); !settled) return settled;
    const auto truthShown = [&](double f) { return update(share(1 / rounds), fmt::format("truth {:.0f} %", 100 * f)); };
    if (auto looked = lookAtTruth(view, pose, truthShown); !looked) return looked;
    // Round 0 compiles shaders, warms caches and gives the pictures; the others are timed. They go there and back, so that no setting
    // always follows the same one and drift favours none.
    for (int round = 0; round <= options_.repetitions; ++round) {
      for (std::size_t n = 0; n < settings_.size(); ++n) {
        const std::size_t i = round % 2 == 0 ? n : settings_.size() - 1 - n;
        const double part = (1 + round + double(n) / double(settings_.size())) / rounds;
        if (!update(share(part), settings_[i].name))
          return Error{fmt::format("{}: stopped before all was measured", options_.input.string())};
        const bool once = settings_[i].frames == Frames::Moving;
        if (once && round > 0) continue;
        if (auto done = once ? fly(i, pose) : still(i, view, pose, round); !done) return done;
      }
    }
    return {};
  }

  bool update(double fraction, const std::string& note) {
    progress_->update(fraction, note);
    return !stopRequested();
  }

  TruthSettings truthSettings() const {
    const int every =
        options_.truth == TruthKind::Gpu ? 1 : options_.truthEvery.value_or(options_.truth == TruthKind::Source ? kSourceEvery : 1);
    return {options_.truth, truth_.quality, every, kRayTolerance, curve(), ev_};
  }

  Result<void> lookAtTruth(const View& view, std::size_t pose, const std::function<bool(double)>& progress) {
    auto drawn = drawTruth(trees_->of(truth_), view, poses_.size, truthSettings(), progress);
    if (!drawn) return drawn.error();
    drawn_ = std::move(*drawn);
    drawnLight_ = chosen(drawn_.light, drawn_.pixels);
    truthErrors_.push_back(drawn_.tolerance);
    if (pose == 0) firstTruth_ = drawn_.image;
    return {};
  }

  Result<void> still(std::size_t i, const View& view, std::size_t pose, int round) {
    const ConvergeSetting& s = settings_[i];
    Renderer& renderer = trees_->of(s);
    if (auto used = renderer.setMarch(s.quality); !used) return used;
    const bool full = s.frames == Frames::Full;
    if (!full) {
      renderer.frame(view, FrameMode::Full);  // another setting's history is gone
      for (int k = 0; k < kHistoryFrames; ++k) renderer.frame(view);
    }
    if (trees_->software()) waitUntilIdle();
    const FrameStats stats = renderer.frame(view, full ? FrameMode::Full : FrameMode::Reprojected);
    if (round > 0) {
      addTimes(works_[i], stats, trees_->software());
      return {};
    }
    return keepPicture(works_[i], renderer, stats, pose);
  }

  // The frames of the path before this one, beginning with a settled tree and a full picture.
  Result<void> fly(std::size_t i, std::size_t pose) {
    const ConvergeSetting& s = settings_[i];
    Renderer& renderer = trees_->of(s);
    if (auto used = renderer.setMarch(s.quality); !used) return used;
    const auto& before = poses_.before[pose];
    renderer.setTime(before.front().time_s);
    renderer.settle(before.front().view);
    FrameStats stats = renderer.frame(before.front().view, FrameMode::Full);
    for (std::size_t k = 1; k <= before.size(); ++k) {
      if (trees_->software()) waitUntilIdle();
      renderer.setTime(k < before.size() ? before[k].time_s : poses_.times_s[pose]);
      stats = renderer.frame(k < before.size() ? before[k].view : poses_.views[pose]);
      addTimes(works_[i], stats, trees_->software());
    }
    if (auto kept = keepPicture(works_[i], renderer, stats, pose); !kept) return kept;
    renderer.settle(poses_.views[pose]);
    return {};
  }

  Result<void> keepPicture(MeasuredSetting& work, Renderer& renderer, const FrameStats& stats, std::size_t pose) {
    const ImageF light = renderer.radiance();
    const Image8 image = renderer.image();
    auto error = measure::compareShown(drawnLight_, chosen(light, drawn_.pixels), curve(), ev_);
    if (!error) return error.error();
    error->flip = std::numeric_limits<double>::quiet_NaN();
    if (drawn_.pixels.empty()) {  // it looks at neighbours
      const auto flip = measure::flipDifference(drawn_.image, image);
      if (!flip) return flip.error();
      error->flip = flip->mean;
    }
    work.errors.push_back(*error);
    work.pictures.push_back(image);
    work.stats = stats;
    if (pose == 0) {
      auto difference = measure::shownDifference(drawn_.light, light, curve(), ev_);
      if (!drawn_.pixels.empty()) keepOnly(difference, drawn_.pixels);
      for (float& d : difference) d = float(d / kShowFull_255);
      work.difference = measure::flipPicture({image.width, image.height, std::move(difference), 0});
    }
    return {};
  }

  ToneCurve curve() const { return poses_.scene.output.toneCurve; }

  const ConvergeOptions& options_;
  Poses poses_;
  std::vector<ConvergeSetting> settings_;
  ConvergeSetting truth_;
  Trees* trees_ = nullptr;
  Progress* progress_ = nullptr;
  std::vector<MeasuredSetting> works_;
  double ev_ = 0;       // of the pose
  TruthPicture drawn_;  // of the pose
  ImageF drawnLight_;   // its pixels that count
  Image8 firstTruth_;
  std::vector<measure::ImageError> truthErrors_;  // tolerances, by pose
};

}  // namespace

Result<void> converge(const ConvergeOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  auto poses = loadPoses(options);
  if (!poses) return poses.error();
  for (const auto& file : {options.common.json, options.html}) {
    if (file.empty()) continue;
    if (auto writable = checkWritableFile(file); !writable) return writable;
  }
  listenForStop();
  Progress progress("converge", options.common.quiet);
  progress.update(0);
  Trees trees(poses->scene, poses->size, options.common.gpu);
  if (auto opened = trees.openContext(); !opened) return opened;
  auto settings = chooseSettings(options, *poses, trees);
  if (!settings) return settings.error();
  Convergence run(options, *poses, *settings);
  if (auto done = run.run(trees, progress); !done) return done;
  progress.finish();

  measure::ConvergeReport report = run.report();
  report.context = describeRun(poses->scene, poses->size);
  report.context.command = options.command;
  describeDevice(trees.context(), report.context);
  if (options.preset == "thesis" && options.sweep.empty()) report.tables = thesisTables(report.rows);
  report.notes = trees.notes();
  report.total_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!options.common.json.empty())
    if (auto written = writeFile(options.common.json, report.json() + "\n"); !written) return written;
  if (!options.html.empty())
    if (auto written = writeFile(options.html, report.html()); !written) return written;
  fmt::print("{}", report.table());
  return {};
}

}  // namespace welkin::app
