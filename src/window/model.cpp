#include "model.h"

#include "welkin/core/files.h"
#include "welkin/core/log.h"
#include "welkin/gpu/timer.h"

namespace welkin::window {
namespace {

constexpr double kMessage_s = 6;

}  // namespace

void Model::start(Scene begun, const View& view) {
  scene = std::move(begun);
  exposure_ev = view.exposure_ev ? view.exposure_ev : scene.output.exposure_ev;
  asLoaded = scene;
  home = view;
  camera.setPlanetRadius(scene.planet.radius_m);
  camera.setView(view);
  wanted = {};
  wanted.rebuild = true;
}

void Model::say(const std::string& text, bool bad) {
  message = oneLine(text, 240);
  messageBad = bad;
  messageUntil_s = gpu::wall_ms() / 1000 + kMessage_s;
  if (bad) log::warn("{}", message);
  else log::info("{}", message);
}

}  // namespace welkin::window
