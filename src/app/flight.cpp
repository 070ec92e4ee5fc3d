#include "welkin/app/flight.h"

#include <chrono>

#include "welkin/app/checksum.h"
#include "welkin/app/contact_sheet.h"
#include "welkin/app/draw.h"
#include "welkin/app/stop.h"
#include "welkin/app/video.h"
#include "welkin/core/files.h"
#include "welkin/core/log.h"
#include "welkin/core/progress.h"
#include "welkin/core/units.h"

namespace welkin::app {
namespace {

constexpr int kChoiceFrames =
    60;  // a march for the tolerance is picked anew so often: the altitude changes by a few times in between at most
constexpr double kSettleShare = 0.1;     // of the progress bar: about the time that settling takes of the whole flight
constexpr double kConvergedFrames = 30;  // a converged picture takes about as long as so many frames of the flight

std::string heightText(double h_m) { return h_m >= 10000 ? fmt::format("{:.0f} km", h_m / 1000) : fmt::format("{:.0f} m", h_m); }

// One replay: what it has and what it leaves.
class Replay {
 public:
  Replay(const FlightOptions& options, FlightPlan plan, const FlightWatch& watch)
      : options_(options), plan_(std::move(plan)), watch_(watch), data_(dataChecksums(plan_.scene)) {
    settings_.width = plan_.size.width;
    settings_.height = plan_.size.height;
    settings_.bricksPerFrame = options.bricksPerFrame;
    settings_.workerJitterSeed = options.workerJitter;
    settings_.waitForEdits = options.waitForEdits;
    settings_.linear = false;
  }

  Result<measure::TimingReport> run() {
    const auto start = std::chrono::steady_clock::now();
    settings_.time_s = pose(plan_.first).time_s;
    go(0, "opening the scene");
    auto stage = openStage(plan_.scene, settings_, options_.common.gpu);
    if (!stage) return stage.error();
    stage_ = std::move(*stage);
    if (auto used = stage_.renderer->setDebugView(options_.debug); !used) return used.error();
    describe();
    if (auto done = drawFrames(); !done) return done.error();
    finishReport();
    if (!stopped()) {
      if (auto done = measureQuality(); !done) return done.error();
    }
    report_.stopped = stopped();
    report_.total_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!pictures_.empty()) {
      if (auto written = writePng(plan_.out / "contact-sheet.png", contactSheet(pictures_), {}); !written) return written.error();
    }
    return std::move(report_);
  }

 private:
  const PathFrame& pose(int frame) const { return plan_.path.frames[std::size_t(frame)]; }

  bool stopped() const { return stopped_ || stopRequested(); }

  bool go(double fraction, const std::string& note) {
    if (watch_.progress && !watch_.progress(fraction, note)) stopped_ = true;
    return !stopped();
  }

  double flightShare() const {  // of the whole progress
    const double frames = plan_.end - plan_.first;
    return frames / (frames + kConvergedFrames * double(options_.qualityFrames.size()));
  }

  // The eye adapts in the flight's time: the scene's may stand still, or run a thousand times as fast.
  double sinceLast_s(int frame) const {
    return plan_.path.timeStep_s > 0 || frame == plan_.first ? plan_.path.timeStep_s : pose(frame).time_s - pose(frame - 1).time_s;
  }

  void describe() {
    report_.context = describeRun(plan_.scene, plan_.size);
    describeDevice(*stage_.context, report_.context);
    report_.context.path = options_.path.generic_string();
    report_.context.command = options_.command;
    report_.context.bricksPerFrame = options_.bricksPerFrame;
    report_.context.deterministic = options_.waitForEdits;
    report_.name = "fly/" + options_.path.stem().string();
  }

  Result<void> drawFrames() {
    std::unique_ptr<VideoWriter> video;
    if (!options_.video.empty()) {
      auto opened = VideoWriter::open(options_.video, plan_.size.width, plan_.size.height, plan_.framesPerSecond);
      if (!opened) return opened.error();
      video = std::move(*opened);
    }
    const int warmUp = plan_.path.warmUp, total = warmUp + plan_.end - plan_.first;
    const double settling = warmUp > 0 ? kSettleShare : 0;  // without a warm-up the flight starts from an empty tree
    const auto drawn = [&](int count, const std::string& note) { go(flightShare() * (settling + (1 - settling) * count / total), note); };
    if (warmUp > 0) {
      stage_.renderer->settle(pose(plan_.first).view, [&](double fraction) { return go(flightShare() * settling * fraction, "settling"); });
    }
    for (int i = 0; i < warmUp && !stopped(); ++i) {
      stage_.renderer->frame(pose(plan_.first).view, FrameMode::Reprojected, plan_.path.timeStep_s);
      drawn(i + 1, "warm-up");
    }
    for (int frame = plan_.first; frame < plan_.end && !stopped(); ++frame) {
      if ((frame - plan_.first) % kChoiceFrames == 0)
        if (auto chosen = chooseMarch(frame); !chosen) return chosen;
      if (auto done = drawFrame(frame, video.get()); !done) return done;
      drawn(warmUp + frame + 1 - plan_.first, heightText(report_.frames.back().altitude_m));
    }
    return video ? video->finish() : Result<void>{};
  }

  // The march that keeps the tolerance here; the tree that is resident is its truth.
  Result<void> chooseMarch(int frame) {
    if (!options_.common.tolerance_255) return {};
    const View& view = pose(frame).view;
    const double exposure_ev = report_.frames.empty() ? view.exposure_ev.value_or(plan_.scene.output.exposure_ev.value_or(0))
                                                      : report_.frames.back().stats.exposure_ev;
    const auto choice =
        measure::chooseMarch(*stage_.renderer, view, exposure_ev, *options_.common.tolerance_255, measure::DrawnAs::Reprojected);
    if (!choice) return choice.error();
    report_.tolerance_255 = options_.common.tolerance_255;
    report_.tolerance.push_back({frame, *choice, {}});
    return {};
  }

  Result<void> drawFrame(int frame, VideoWriter* video) {
    const View& view = pose(frame).view;
    stage_.renderer->setTime(pose(frame).time_s);
    // The first frame has no tree before it.
    const bool pop = options_.pop && frame > plan_.first && frame >= options_.pop->first && frame < options_.pop->end.value_or(plan_.end);
    Image8 before;
    if (pop) {
      stage_.renderer->preview(view);
      before = stage_.renderer->image();
    }
    measure::FrameRow row;
    row.pathFrame = frame;
    row.time_s = pose(frame).time_s;
    row.altitude_m = altitude_m(view, plan_.scene.planet);
    row.stats = stage_.renderer->frame(view, FrameMode::Reprojected, sinceLast_s(frame));
    const bool quality = std::find(options_.qualityFrames.begin(), options_.qualityFrames.end(), frame) != options_.qualityFrames.end();
    const bool wanted = pictureWanted(plan_, frame);
    if (wanted || quality || video || watch_.picture) {
      Image8 image = stage_.renderer->image();
      if (watch_.picture) watch_.picture(frame, image);
      if (video) {
        if (auto added = video->add(image); !added) return added;
      }
      if (wanted) {
        row.picture = pictureName(frame);
        if (auto written = writePicture(frame, image, row.stats.exposure_ev); !written) return written;
      }
      if (quality) qualityImages_.push_back({frame, row.stats.exposure_ev, std::move(image)});
    }
    if (pop) {
      stage_.renderer->preview(view);
      const auto change = measure::compare(before, stage_.renderer->image());
      if (!change) return change.error();
      report_.pops.push_back({frame, change->p999_255, change->mean_255, change->max_255});
    }
    report_.frames.push_back(std::move(row));
    return {};
  }

  Result<void> writePicture(int frame, const Image8& image, double exposure_ev) {
    const auto state = stateOf(*stage_.renderer, pose(frame).view, exposure_ev, plan_.size, pose(frame).time_s, false, data_);
    pictures_.push_back({image, fmt::format("frame {}   {}", frame, heightText(altitude_m(pose(frame).view, plan_.scene.planet)))});
    return writePng(plan_.out / pictureName(frame), image, textsFromState(state, plan_.out));
  }

  void finishReport() {
    const auto& renderer = *stage_.renderer;
    report_.leftOut = renderer.plan().leftOut;
    report_.passOrder = renderer.plan().passes;
    report_.memoryByName = renderer.memory().byName();
    report_.notes = renderer.notes();
    if (options_.debug != DebugView::None) report_.debug = debugNumbers(options_.debug, renderer.debugValues());
    report_.glMessages = stage_.context->debugMessages();
    report_.glFirstMessages = stage_.context->firstMessages();
  }

  // A second renderer after the first is gone: the flight is not disturbed, and memory stays within one budget.
  Result<void> measureQuality() {
    if (qualityImages_.empty()) return {};
    stage_.renderer.reset();
    auto reference = Renderer::create(*stage_.context, plan_.scene, settings_);
    if (!reference) return reference.error();
    for (std::size_t i = 0; i < qualityImages_.size(); ++i) {
      const auto& [frame, exposure_ev, image] = qualityImages_[i];
      View view = pose(frame).view;
      view.exposure_ev = exposure_ev;  // as the flight had adapted
      (*reference)->setTime(pose(frame).time_s);
      const auto drawn = drawConverged(**reference, view, [&, frame = frame](double f) {
        const double part = (double(i) + f) / double(qualityImages_.size());
        return go(flightShare() + (1 - flightShare()) * part, fmt::format("converged, frame {}", frame));
      });
      if (!drawn) return {};  // it was stopped
      auto error = measure::compare((*reference)->image(), image);
      if (!error) return error.error();
      report_.quality.push_back({frame, *error});
    }
    return {};
  }

  const FlightOptions& options_;
  FlightPlan plan_;
  const FlightWatch& watch_;
  bool stopped_ = false;
  std::map<std::filesystem::path, std::string> data_;
  RenderSettings settings_;
  Stage stage_;
  measure::TimingReport report_;
  std::vector<SheetPicture> pictures_;
  struct QualityImage {
    int frame;
    double exposure_ev;
    Image8 image;
  };
  std::vector<QualityImage> qualityImages_;
};

void printSummary(const measure::TimingReport& report) {
  fmt::print("{}", report.table());
  if (report.frames.empty()) return;
  fmt::print("{} frames at {}x{}, {} of {} used at most, on {}\n", report.frames.size(), report.context.width, report.context.height,
             bytesText(report.greatestBytes()), bytesText(report.context.budget_bytes), report.context.glRenderer);
  if (!report.quality.empty()) {
    std::vector<double> rmse;
    for (const auto& row : report.quality) rmse.push_back(row.error.rmse_255);
    const auto s = measure::summarize(rmse);
    fmt::print("RMSE against the converged picture, 0-255, {} frames: median {:.2f}, max {:.2f}\n", s.n, s.median, s.max);
  }
  if (!report.pops.empty()) {
    double greatest = 0;
    for (const auto& row : report.pops) greatest = std::max(greatest, row.p999_255);
    fmt::print("change by the tree alone, p99.9, 0-255, {} frames: {:.2f} at most\n", report.pops.size(), greatest);
  }
}

void warnOf(const measure::TimingReport& report) {
  if (report.nanPixels() > 0) log::warn("{} pixels were not a number", report.nanPixels());
  if (report.holes() > 0) log::warn("{} rays met a place without data", report.holes());
  if (report.glMessages > 0)
    log::warn("{} messages of the GL, the first: {}", report.glMessages, report.glFirstMessages.empty() ? "" : report.glFirstMessages[0]);
}

}  // namespace

Result<measure::TimingReport> replay(const FlightOptions& options, FlightPlan plan, const FlightWatch& watch) {
  return Replay(options, std::move(plan), watch).run();
}

Result<void> fly(const FlightOptions& options) {
  const auto plan = planFlight(options);
  if (!plan) return plan.error();
  listenForStop();
  Progress progress("fly", options.common.quiet);
  const auto report = replay(options, *plan,
                             {[&](double fraction, const std::string& note) {
                                progress.update(fraction, note);
                                return true;  // Ctrl-C is looked after already
                              },
                              {}});
  progress.finish();
  if (!report) return report.error();
  if (auto written = writeFile(plan->json, report->json() + "\n"); !written) return written;
  printSummary(*report);
  fmt::print("{}\n", plan->json.string());
  warnOf(*report);
  if (report->stopped)
    return Error{fmt::format("{}: stopped after {} of {} frames", options.path.string(), report->frames.size(), plan->end - plan->first)};
  return {};
}

}  // namespace welkin::app
