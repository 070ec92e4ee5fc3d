#include "viewer.h"

#include <algorithm>
#include <cmath>

#include "brick_pace.h"
#include "controls.h"
#include "file_loader.h"
#include "flight_show.h"
#include "interface.h"
#include "log_lines.h"
#include "painter.h"
#include "panels.h"
#include "presenter.h"
#include "screenshots.h"
#include "state_report.h"
#include "welkin/app/settings.h"
#include "welkin/app/stop.h"
#include "welkin/core/files.h"
#include "welkin/core/log.h"
#include "welkin/physics/scene_io.h"
#include "written_files.h"

namespace welkin::window {
namespace {

constexpr double kIdleWait_s = 0.03, kMeasuringWait_s = 0.1, kLate_s = 0.1, kStateEvery_s = 0.5, kMostStep_s = 0.25, kRest_ms = 700;
constexpr double kMostWait_ms = 28;        // for a picture; one that takes longer is shown in a later frame, and the interface goes on
constexpr double kLoadingWait_ms = 5;      // while a renderer is made the processor has much to do
constexpr std::uint64_t kFirstFrames = 8;  // not among the slowest: the interface's shaders are compiled for them
constexpr double kSlowTime = 2;            // times as fast as it is: slower than a frame shows
constexpr double kSpareDetail = 1.4;       // for the next step of a flight

bool sameView(const View& a, const View& b) {
  return a.position_m == b.position_m && a.orientation == b.orientation && a.fov_deg == b.fov_deg && a.exposure_ev == b.exposure_ev;
}

// Stretched, they must not mix: what lies between the colours of two kinds is a third one's.
bool falseColours(const std::optional<DebugNumbers>& debug) { return debug && debug->view != DebugView::Air; }

class Viewer {
 public:
  Viewer(const ViewOptions& options, app::Settings&& settings, app::Restored&& restored, Window& window, gpu::Context& context)
      : options_(options),
        window_(window),
        context_(context),
        interface_(window),
        painters_{std::make_unique<Painter>(window.hidden(0)), std::make_unique<Painter>(window.hidden(1))},
        shots_(options.shots, options.common.gpu),
        flights_(options.common.gpu) {
    if (!options.state.empty()) flights_.rememberShown();
    model_.device = context.device().renderer;
    model_.software = context.device().software;
    restored.start.time_s = options.common.time_s.value_or(restored.start.time_s);
    begin(std::move(restored.start));
    if (restored.path) loadFlight(model_, std::move(*restored.path));
    model_.settings = std::move(settings);
    interface_.setScale(model_.settings.uiScale);
  }

  void run() {
    double last_ms = gpu::wall_ms();
    while (!window_.closing() && !app::stopRequested()) {
      const Events events = window_.poll(flights_.running() ? kMeasuringWait_s : idle_ ? kIdleWait_s : painter().drawing() ? kLate_s : 0);
      const double now_ms = gpu::wall_ms(), dt_s = std::min((now_ms - last_ms) / 1000, kMostStep_s);
      last_ms = now_ms;
      frame(events, now_ms, dt_s);
    }
    if (!options_.common.size) {  // else it was asked for once
      const Placement place = window_.placement();
      model_.settings.width = place.size.width, model_.settings.height = place.size.height;
      model_.settings.position = place.position, model_.settings.maximized = place.maximized;
      keepSettings();
    }
    window_.hide();  // a renderer that is being made, and pictures that are being written, are finished unseen
    report();
  }

 private:
  void begin(app::Start&& start) {
    model_.viewName = start.viewName;
    model_.time_s = start.time_s;
    model_.debug = start.debug.value_or(model_.debug);  // a scene or a path leaves it as it is
    app::apply(options_.common, start.scene);
    app::apply(options_.common, start.view);
    model_.start(std::move(start.scene), start.view);
    window_.setTitle("Welkin: " + oneLine(model_.scene.name, 60));
  }

  void frame(const Events& events, double now_ms, double dt_s) {
    for (const Press& press : events.pressed)
      if (!interface_.wantsKeys()) Controls::press(model_, window_, press);
    if (!flights_.running()) controls_.fly(model_, window_, events, !interface_.wantsMouse(), !interface_.wantsKeys(), dt_s);
    if (interface_.busy() || !events.pressed.empty()) flights_.moveOn();
    if (model_.camera.moves() || interface_.busy() || !events.pressed.empty() || model_.deck.mode() != Deck::Mode::Idle ||
        (model_.playing && model_.timeSpeed > kSlowTime && model_.timeMoves()) ||
        !sameView(model_.view(), last_))
      moved_ms_ = now_ms;
    last_ = model_.view();
    for (const auto& file : events.dropped) load(file);
    if (model_.playing && model_.deck.mode() != Deck::Mode::Playing && !flights_.running()) model_.time_s += dt_s * model_.timeSpeed;
    model_.runTape(dt_s);
    model_.frameRate += (1 / std::max(dt_s, 1e-3) - model_.frameRate) * std::min(1.0, dt_s * 2);
    carryOut();
    model_.window = window_.pixels();
    const bool minimised = model_.window.width <= 0 || model_.window.height <= 0;
    if (!minimised) show(now_ms, dt_s);
    ++counts_.frames;
    idle_ = minimised || !model_.painted || flights_.shows(model_.view()) || (model_.stats.leftOut == "nothing-moves" && !loading_);
    if (now_ms - reported_ms_ > 1000 * kStateEvery_s) reported_ms_ = now_ms, report();
  }

  // A picture and the interface over it. Without a new picture in time, the last one.
  void show(double begun_ms, double dt_s) {
    const double input_ms = gpu::wall_ms();
    const std::optional<double> picture_ms = draw(dt_s);
    const double pictured_ms = gpu::wall_ms();
    if (flights_.shows(model_.view()))
      flights_.draw(presenter_, model_.window);
    else if (model_.painted && model_.painted->canvas)
      presenter_.show(*model_.painted->canvas, model_.window, falseColours(model_.painted->debug) ? GL_NEAREST : GL_LINEAR);
    else
      presenter_.clear(model_.window);
    if (counts_.frames == 0) presenter_.prepare(model_.window), presenter_.clear(model_.window);
    if (model_.software) glFinish();  // so that the profiler tells the parts apart
    const double stretched_ms = gpu::wall_ms();
    interface_.begin();
    drawInterface(model_);
    interface_.end();
    if (model_.software) glFinish();
    const double interface_ms = gpu::wall_ms();
    window_.swap();
    const double shown_ms = gpu::wall_ms();
    const std::map<std::string, double> parts_ms{{"input", input_ms - begun_ms},
                                                 {"picture", pictured_ms - input_ms},
                                                 {"stretch", stretched_ms - pictured_ms},
                                                 {"interface", interface_ms - stretched_ms},
                                                 {"show", shown_ms - interface_ms}};
    // A GPU waits for the display in swap; software has a copy to make.
    const double end_ms = model_.software ? shown_ms : interface_ms;
    if (counts_.frames > kFirstFrames && end_ms - begun_ms > counts_.worstFrame_ms)
      counts_.worstFrame_ms = end_ms - begun_ms, counts_.worst_ms = parts_ms;
    if (picture_ms) timed(*picture_ms + input_ms - begun_ms + end_ms - pictured_ms, parts_ms);
    if (picture_ms && counts_.firstPicture_s < 0) {
      counts_.firstPicture_s = (gpu::wall_ms() - options_.begun_ms) / 1000;
      log::info("first picture after {:.2f} s", counts_.firstPicture_s);
    }
  }

  // frame_ms: the picture's and the interface's, whether they were one after the other or not.
  void timed(double frame_ms, const std::map<std::string, double>& parts_ms) {
    // A picture that is left as it is may still get larger, but not smaller: the last one drawn was the first of its size, and so a slow
    // one.
    const bool drawn = model_.stats.leftOut != "nothing-moves";
    if (drawn) drawn_ms_ = frame_ms;
    double cost_ms = drawn ? frame_ms : std::min(drawn_ms_, kMostRest_ms);
    const bool still = gpu::wall_ms() - moved_ms_ > kRest_ms && !loading_ && model_.painted;
    const bool sharp = still && model_.stats.sampleDetail >= 0.99 * model_.painted->shownDetail;  // as its size lets it be
    rests_ = still && (rests_ || sharp);
    if (rests_ && !sharp) cost_ms = std::max(cost_ms, kMostRest_ms / 1.5);  // no larger before
    model_.scale.frame(cost_ms, rests_);
    auto passes = model_.stats.passes;
    for (const auto& [name, ms] : parts_ms)
      if (name != "picture") passes[name].wall_ms = ms;  // its passes are told one by one
    model_.times.add(frame_ms, passes);
    pace_.made(std::max(model_.stats.bricksGenerated, model_.stats.bricksLit), passes["bricks"].wall_ms + passes["light"].wall_ms);
  }

  // What is asked for is done, or begun.
  void carryOut() {
    takeLoaded();
    model_.keepEdits();
    flights_.advance(model_);
    const Wanted wanted = std::exchange(model_.wanted, {});
    bool rebuild = wanted.rebuild;
    if (wanted.saveScene) save("scene", writeScene(model_, folder()));
    bool savePath = wanted.savePath;
    if (wanted.endRecording) {
      const auto ended = model_.deck.endRecording(model_.scene.name, model_.window.width, model_.window.height);
      if (!ended) savePath = false, model_.say(ended.error().message, true);
    }
    if (wanted.flight && !wanted.stopFlight) {
      if (loading_)
        model_.wanted.flight = wanted.flight;  // once the scene is there: making it would be measured too
      else if (!flights_.running())
        replay(*wanted.flight);
    }
    if (savePath) save("path", writePath(model_, folder()));
    if (model_.settingsChanged) model_.settingsChanged = false, keepSettings();
    if (wanted.march) order_.march = later_.march = model_.scene.quality;
    if (wanted.output) order_.output = later_.output = model_.scene.output;
    if (wanted.air) order_.air = later_.air = model_.scene;
    if (wanted.picture) keep_ = true;
    rebuild |= std::exchange(airRefused_, false);
    if (rebuild) make();
    if (auto made = other().made()) take(*made);
    model_.loading_s = loading_ ? (gpu::wall_ms() - makeBegun_ms_) / 1000 : -1;
    if (wanted.convergedPicture) {
      shots_.takeConverged(model_.scene, model_.view(), model_.window, model_.time_s);
      model_.say("a converged picture is being made");
    }
    for (const auto& note : shots_.news()) model_.say(note.text, note.bad);
  }

  // As `welkin fly` would: so from a file.
  void replay(FlightTask task) {
    std::filesystem::path file = model_.deck.fileOf(sceneToJson(model_.scene));
    if (file.empty()) {
      const auto written = writePath(model_, folder());
      if (!written) return model_.say(written.error().message, true);
      file = *written;
    }
    flights_.begin(model_, task, file, folder());
  }

  RenderSettings settings() const {
    RenderSettings s;
    const app::Size size = model_.scale.sizeFor(window_.pixels());
    s.width = std::max(size.width, 16), s.height = std::max(size.height, 16);
    s.bricksPerFrame = pace_.perFrame();
    s.waitForEdits = false;
    s.time_s = model_.time_s;
    s.linear = false;
    s.spareDetail = kSpareDetail;
    return s;
  }

  // A renderer for the scene as it is now, by the painter that does not show; the other goes on until it is there.
  void make() {
    loading_ = true;
    makeBegun_ms_ = gpu::wall_ms();
    later_ = {};
    other().make(model_.scene, settings(), model_.view());
  }

  void take(const Result<void>& made) {
    loading_ = false;
    if (!made) {
      model_.say(made.error().message, true);
      return;
    }
    ++counts_.made;
    painter().end();
    shown_ = 1 - shown_;
    painter().take(0);  // the last picture of the renderer that it had before
    order_.march = later_.march, order_.output = later_.output, order_.air = later_.air;  // what was changed while it was made
    told_ = false;
  }

  void save(const char* what, const Result<std::filesystem::path>& file) {
    model_.say(file ? fmt::format("wrote the {}: {}", what, file->string()) : file.error().message, !file);
  }

  std::filesystem::path folder() const { return options_.shots.empty() ? "." : options_.shots; }

  void keepSettings() {
    const auto file = app::settingsFile();
    if (file.empty()) return;
    if (auto saved = app::saveSettings(model_.settings, file); !saved) model_.say(saved.error().message, true);
  }

  void load(const std::filesystem::path& file) {
    model_.say("reading " + file.filename().string());
    files_.begin(file);
  }

  void takeLoaded() {
    auto restored = files_.take();
    if (!restored) return;
    if (*restored)
      use(std::move(**restored));
    else
      model_.say(restored->error().message, true);
  }

  void use(app::Restored restored) {
    if (restored.result) {
      model_.say("a result of a flight: " + restored.result->file.filename().string());
      model_.showResult(std::move(*restored.result));
      return;
    }
    if (flights_.running() || model_.deck.mode() == Deck::Mode::Recording)
      return model_.say("files are loaded once the flight that is recorded or replayed has ended", true);
    model_.deck.stop();
    const auto notes = restored.start.notes;
    const DebugView debug = restored.start.debug.value_or(DebugView::None);
    begin(std::move(restored.start));
    const bool flight = restored.path.has_value();
    if (flight) loadFlight(model_, std::move(*restored.path));
    std::string said = (flight ? "a recorded flight of " : "restored ") + oneLine(model_.scene.name, 60);
    if (debug != DebugView::None) said += fmt::format(", debug view {}", kDebugViewNames[std::size_t(debug)]);
    model_.say(said);
    for (const auto& note : notes) model_.say(note, true);
  }

  // Orders a picture if none is being drawn, and waits for it, but not for long. If it came: what it took.
  std::optional<double> draw(double dt_s) {
    order_.sinceLast_s += dt_s;
    if (!painter().drawing() && !flights_.running() && !flights_.shows(model_.view())) {
      const app::Size size = model_.scale.sizeFor(model_.window);
      order_.size = {std::max(size.width, 16), std::max(size.height, 16)};
      order_.view = model_.view();
      order_.mode = model_.reprojection ? FrameMode::Reprojected : FrameMode::Full;
      order_.debug = model_.debug;
      order_.time_s = model_.time_s;
      order_.bricksPerFrame = pace_.perFrame();
      order_.keep = keep_;
      painter().draw(std::exchange(order_, {}));
      ordered_ = counts_.frames;
    }
    auto painted = painter().take(loading_ ? kLoadingWait_ms : kMostWait_ms);
    if (!painted) return {};
    for (const auto& failed : painted->failed) model_.say(failed, true);
    airRefused_ |= painted->airRefused;
    if (painted->kept) keep_ = false, shots_.takeAsSeen(std::move(painted->kept->image), std::move(painted->kept->state));
    if (!painted->canvas) return {};  // before the first renderer is there, an empty one
    model_.stats = painted->stats;
    if (painted->size.width != model_.picture.width || painted->size.height != model_.picture.height) ++counts_.resizes;
    model_.picture = painted->size;
    if (!std::exchange(told_, true))
      for (const auto& note : painted->notes) model_.say(note, true);
    ++counts_.pictures;
    ++counts_.latency[std::min<std::size_t>(counts_.frames - ordered_, counts_.latency.size() - 1)];
    counts_.nanPixels += model_.stats.counters.nanPixels;
    if (model_.stats.sampleDetail >= 1) counts_.holes += model_.stats.counters.holes;  // before, the tree promises nothing
    model_.painted = std::move(*painted);
    return model_.painted->ms;
  }

  Painter& painter() { return *painters_[std::size_t(shown_)]; }
  Painter& other() { return *painters_[std::size_t(1 - shown_)]; }

  void report() {
    if (options_.state.empty()) return;
    counts_.seconds = (gpu::wall_ms() - options_.begun_ms) / 1000;
    counts_.glMessages = context_.debugMessages() + painter().glMessages() + other().glMessages();
    if (auto written = writeFile(options_.state, stateJson(model_, counts_, flights_.shown())); !written)
      log::warn("{}", written.error().message);
  }

  const ViewOptions& options_;
  Window& window_;
  gpu::Context& context_;
  LogLines logLines_;
  Model model_;
  Interface interface_;
  Presenter presenter_;
  std::array<std::unique_ptr<Painter>, 2> painters_;  // one's pictures are shown; the other makes the next renderer
  int shown_ = 0;                                     // which
  Screenshots shots_;
  FlightShow flights_;
  Controls controls_;
  FileLoader files_;
  Counts counts_;
  BrickPace pace_;
  Order order_;  // the next
  struct {
    std::optional<Quality> march;
    std::optional<Output> output;
    std::optional<Scene> air;
  } later_;                                                                  // changed while a renderer is made
  bool loading_ = false, airRefused_ = false, keep_ = false, told_ = false;  // keep: a picture is to be written; told: the renderer's notes
  double makeBegun_ms_ = 0;
  bool rests_ = false;         // nobody moves, and the picture was as sharp as its size lets it be
  double drawn_ms_ = 0;        // of the last frame whose picture was drawn
  std::uint64_t ordered_ = 0;  // the frame in which the last picture was ordered
  bool idle_ = false;
  View last_;
  double moved_ms_ = 0;  // the last time that anything did
  double reported_ms_ = 0;
};

}  // namespace

void runViewer(const ViewOptions& options, app::Settings&& settings, app::Restored&& restored, Window& window, gpu::Context& context) {
  Viewer(options, std::move(settings), std::move(restored), window, context).run();
}

}  // namespace welkin::window
