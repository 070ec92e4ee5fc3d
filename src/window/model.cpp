#include "model.h"

#include "welkin/core/files.h"
#include "welkin/core/log.h"
#include "welkin/gpu/timer.h"
#include "welkin/physics/scene_io.h"
#include "widgets.h"

namespace welkin::window {
namespace {

constexpr double kMessage_s = 6;

}  // namespace

void Model::start(Scene begun, const View& view) {
  scene = std::move(begun);
  exposure_ev = view.exposure_ev ? view.exposure_ev : scene.output.exposure_ev;
  scene.output.exposure_ev = exposure_ev;  // one place for it, so that undo finds it
  asLoaded = scene;
  edits = app::EditHistory<Scene>(scene);
  home = view;
  camera.setPlanetRadius(scene.planet.radius_m);
  camera.setView(view);
  wanted.march = wanted.air = wanted.output = false;
  wanted.flight.reset();
  wanted.rebuild = true;
}

void Results::add(app::FlightResult result) {
  all.push_back(std::move(result));
  const int newest = int(all.size()) - 1;
  if (a >= 0 && b >= 0) a = b;
  (a < 0 ? a : b) = newest;
}

void Model::runTape(double dt_s) {
  if (deck.mode() == Deck::Mode::Recording && !deck.add(dt_s, view(), time_s)) {
    wanted.endRecording = true;
    say("the recording is full", true);
  }
  if (deck.mode() == Deck::Mode::Playing) show(deck.advance(dt_s));
}

void Model::show(const PathFrame& frame) {
  camera.setView(frame.view);
  if (frame.view.exposure_ev) exposure_ev = frame.view.exposure_ev;
  time_s = frame.time_s;
}

void Model::showResult(app::FlightResult result) {
  results.add(std::move(result));
  open[std::size_t(Panel::Results)] = true;
  showNow = Panel::Results;
}

void Model::keepEdits() {
  const std::string what = takeFinishedEdit();
  if (what.empty() || sceneToJson(scene) == sceneToJson(edits.current())) return;
  edits.push(scene, what);
  edits.settle();
}

void Model::undo() {
  if (!edits.canUndo()) return;
  say("undone: " + edits.undoes());
  show(edits.undo());
}

void Model::redo() {
  if (!edits.canRedo()) return;
  say("done again: " + edits.redoes());
  show(edits.redo());
}

void Model::show(const Scene& other) {
  const auto text = [](Scene s, bool air) {  // without what changes live; with or without what Renderer::setAir changes
    s.quality = {}, s.output = {};
    if (!air) {
      s.planet.albedo = {};
      if (s.atmosphere) s.atmosphere = Atmosphere{};
      if (s.sun) s.sun = Sun{};
      if (s.clouds) s.clouds->windEast_m_per_s = 0;
    }
    return sceneToJson(s);
  };
  const bool rebuild = text(other, false) != text(scene, false) || other.quality.budget_bytes != scene.quality.budget_bytes ||
                       other.quality.depth != scene.quality.depth || other.quality.seed != scene.quality.seed;
  if (!rebuild && text(other, true) != text(scene, true)) wanted.air = true;
  scene = other;
  exposure_ev = scene.output.exposure_ev;
  wanted.rebuild |= rebuild;
  if (!rebuild) wanted.march = wanted.output = true;
}

void Model::say(const std::string& text, bool bad) {
  message = oneLine(text, 240);
  messageBad = bad;
  messageUntil_s = gpu::wall_ms() / 1000 + kMessage_s;
  if (bad)
    log::warn("{}", message);
  else
    log::info("{}", message);
}

}  // namespace welkin::window
