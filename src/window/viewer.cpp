#include "viewer.h"

#include <algorithm>
#include <cmath>

#include "brick_pace.h"
#include "controls.h"
#include "file_loader.h"
#include "flight_show.h"
#include "interface.h"
#include "log_lines.h"
#include "panels.h"
#include "presenter.h"
#include "renderer_loader.h"
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

constexpr double kIdleWait_s = 0.03, kMeasuringWait_s = 0.1, kStateEvery_s = 0.5, kMostStep_s = 0.25, kRest_ms = 700;
constexpr std::uint64_t kFirstPictures = 8;  // not among the slowest: shaders are compiled for them
constexpr double kSpareDetail = 1.4;         // for the next step of a flight

bool sameView(const View& a, const View& b) {
  return a.position_m == b.position_m && a.orientation == b.orientation && a.fov_deg == b.fov_deg && a.exposure_ev == b.exposure_ev;
}

class Viewer {
 public:
  Viewer(const ViewOptions& options, app::Settings&& settings, app::Start&& start, Window& window, gpu::Context& context)
      : options_(options),
        window_(window),
        context_(context),
        interface_(window),
        glThread_(window.hidden(), pool_),
        loader_(glThread_, context),
        shots_(options.shots, options.common.gpu),
        flights_(options.common.gpu) {
    if (!options.state.empty()) flights_.rememberShown();
    gpu::usePool(pool_);
    model_.device = context.device().renderer;
    model_.software = context.device().software;
    begin(std::move(start));
    model_.settings = std::move(settings);
    interface_.setScale(model_.settings.uiScale);
  }

  void run() {
    double last_ms = gpu::wall_ms();
    while (!window_.closing() && !app::stopRequested()) {
      const Events events = window_.poll(flights_.running() ? kMeasuringWait_s : idle_ ? kIdleWait_s : 0);
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
        !sameView(model_.view(), last_))
      moved_ms_ = now_ms;
    last_ = model_.view();
    for (const auto& file : events.dropped) load(file);
    model_.runTape(dt_s);
    if (model_.playing) model_.time_s += dt_s * model_.timeSpeed;
    model_.frameRate += (1 / std::max(dt_s, 1e-3) - model_.frameRate) * std::min(1.0, dt_s * 2);
    carryOut();
    model_.window = window_.pixels();
    begun_ms_ = gpu::wall_ms();
    const bool minimised = model_.window.width <= 0 || model_.window.height <= 0;
    if (!minimised) {
      draw(dt_s);
      if (model_.software) glFinish();  // so that the profiler tells the parts apart
      const double drawn_ms = gpu::wall_ms();
      interface_.begin();
      drawInterface(model_);
      interface_.end();
      if (model_.software) glFinish();
      const double interface_ms = gpu::wall_ms();
      window_.swap();
      const double shown_ms = gpu::wall_ms();
      // A GPU waits for the display in swap; software has a copy to make.
      const double frame_ms = (model_.software ? shown_ms : interface_ms) - now_ms;
      if (drawn_ && !flights_.running())
        timed(frame_ms, {{"input", begun_ms_ - now_ms},
                         {"draw", pictured_ms_ - begun_ms_},
                         {"stretch", drawn_ms - pictured_ms_},
                         {"interface", interface_ms - drawn_ms},
                         {"show", shown_ms - interface_ms}});
      if (drawn_ && counts_.firstPicture_s < 0) {
        counts_.firstPicture_s = (gpu::wall_ms() - options_.begun_ms) / 1000;
        log::info("first picture after {:.2f} s", counts_.firstPicture_s);
      }
    }
    ++counts_.frames;
    idle_ = minimised || !drawn_ || flights_.shows(model_.view()) || model_.stats.leftOut == "nothing-moves";
    if (now_ms - reported_ms_ > 1000 * kStateEvery_s) reported_ms_ = now_ms, report();
  }

  void timed(double frame_ms, const std::map<std::string, double>& parts_ms) {
    if (model_.stats.leftOut != "nothing-moves") model_.scale.frame(frame_ms, rests());
    auto passes = model_.stats.passes;
    for (const auto& [name, ms] : parts_ms)
      if (name != "draw") passes[name].wall_ms = ms;  // its passes are told one by one
    model_.times.add(frame_ms, passes);
    if (pictures_ <= kFirstPictures)
      counts_.switch_ms = std::max(counts_.switch_ms, frame_ms);
    else if (frame_ms > counts_.worstFrame_ms) {
      counts_.worstFrame_ms = frame_ms;
      counts_.worst_ms = parts_ms;
      for (const auto& [name, time] : passes) counts_.worst_ms[name] = time.wall_ms;
    }
    if (!renderer_) return;
    pace_.made(model_.stats.bricksGenerated, passes["bricks"].wall_ms + passes["light"].wall_ms);
    renderer_->setBricksPerFrame(pace_.perFrame());
  }

  // Has nobody moved or pressed anything for a while, and is the picture as sharp as its size lets it be?
  bool rests() const {
    return gpu::wall_ms() - moved_ms_ > kRest_ms && loader_.since_s() == 0 && renderer_ &&
           model_.stats.sampleDetail >= 0.99 * renderer_->shownDetail(model_.view());
  }

  // What is asked for is done, or begun.
  void carryOut() {
    takeLoaded();
    model_.keepEdits();
    flights_.advance(model_);
    const Wanted wanted = std::exchange(model_.wanted, {});
    bool rebuild = wanted.rebuild;
    if (wanted.saveScene) save("scene", writeScene(model_, folder()));
    if (wanted.endRecording) {
      const auto ended = model_.deck.endRecording(model_.scene.name, model_.window.width, model_.window.height);
      if (!ended) model_.say(ended.error().message, true);
    }
    if (wanted.flight && !flights_.running()) replay(*wanted.flight);
    if (wanted.savePath) save("path", writePath(model_, folder()));
    if (model_.settingsChanged) model_.settingsChanged = false, keepSettings();
    if (renderer_ && !rebuild) {
      const auto done = [this](const Result<void>& r) {
        if (!r) model_.say(r.error().message, true);
      };
      if (wanted.march) done(renderer_->setMarch(model_.scene.quality));
      if (wanted.output) done(renderer_->setOutput(model_.scene.output));
      if (wanted.air && !renderer_->setAir(model_.scene, Renderer::AirChange::Recompute)) rebuild = true;
    }
    if (rebuild) loader_.begin(model_.scene, settings(), model_.view());
    if (auto made = loader_.take()) use(std::move(*made));
    model_.loading_s = loader_.busy() ? loader_.since_s() : -1;
    if (wanted.picture && renderer_ && drawn_)
      shots_.takeAsSeen(renderer_->image(), *renderer_, model_.view(), model_.stats.exposure_ev, model_.time_s);
    if (wanted.convergedPicture && renderer_) {
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
    s.linear = false;
    s.spareDetail = kSpareDetail;
    return s;
  }

  void use(RendererLoader::Made made) {
    if (!made) {
      model_.say(made.error().message, true);
      return;
    }
    loader_.end(std::move(renderer_));
    renderer_ = std::move(*made);
    model_.renderer = renderer_.get();
    drawn_ = false;
    pictures_ = 0;
    for (const auto& note : renderer_->notes()) model_.say(note, true);
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
      model_.results.add(std::move(*restored.result));
      model_.open[std::size_t(Panel::Results)] = true;
      model_.showNow = Panel::Results;
      return;
    }
    const auto notes = restored.start.notes;
    begin(std::move(restored.start));
    const bool flight = restored.path.has_value();
    if (flight) loadFlight(model_, std::move(*restored.path));
    model_.say(flight ? "a recorded flight of " + oneLine(model_.scene.name, 60) : "restored " + oneLine(model_.scene.name, 60));
    for (const auto& note : notes) model_.say(note, true);
  }

  void draw(double dt_s) {
    const app::Size size = model_.scale.sizeFor(model_.window);
    const bool paused = flights_.running() || flights_.shows(model_.view());
    if (renderer_ && !paused) {
      if (size.width != model_.picture.width || size.height != model_.picture.height || !drawn_) {
        if (auto fits = renderer_->resize(size.width, size.height); !fits) model_.say(fits.error().message, true);
        model_.picture = size;
        ++counts_.resizes;
      }
      const View view = model_.view();
      model_.stats = renderer_->frame(view, model_.reprojection ? FrameMode::Reprojected : FrameMode::Full, dt_s);
      drawn_ = true;
      ++counts_.pictures, ++pictures_;
      counts_.nanPixels += model_.stats.counters.nanPixels;
      if (model_.stats.sampleDetail >= 1) counts_.holes += model_.stats.counters.holes;  // before, the tree promises nothing
    }
    pictured_ms_ = gpu::wall_ms();
    if (flights_.shows(model_.view()))
      flights_.draw(presenter_, model_.window);
    else if (renderer_ && drawn_)
      presenter_.show(renderer_->shown(), model_.window);
    else
      presenter_.clear(model_.window);
  }

  void report() {
    if (options_.state.empty()) return;
    counts_.seconds = (gpu::wall_ms() - options_.begun_ms) / 1000;
    counts_.glMessages = context_.debugMessages() + glThread_.glMessages();
    if (auto written = writeFile(options_.state, stateJson(model_, counts_, flights_.shown())); !written) log::warn("{}", written.error().message);
  }

  const ViewOptions& options_;
  Window& window_;
  gpu::Context& context_;
  LogLines logLines_;
  Model model_;
  Interface interface_;
  Presenter presenter_;
  std::shared_ptr<gpu::ProgramPool> pool_ = std::make_shared<gpu::ProgramPool>();
  GlThread glThread_;
  RendererLoader loader_;
  Screenshots shots_;
  FlightShow flights_;
  Controls controls_;
  std::unique_ptr<Renderer> renderer_;
  FileLoader files_;
  Counts counts_;
  BrickPace pace_;
  bool drawn_ = false;          // a picture of this renderer is there
  std::uint64_t pictures_ = 0;  // of this renderer
  bool idle_ = false;
  View last_;
  double moved_ms_ = 0;  // the last time that anything did
  double reported_ms_ = 0, begun_ms_ = 0, pictured_ms_ = 0;
};

}  // namespace

void runViewer(const ViewOptions& options, app::Settings&& settings, app::Start&& start, Window& window, gpu::Context& context) {
  Viewer(options, std::move(settings), std::move(start), window, context).run();
}

}  // namespace welkin::window
