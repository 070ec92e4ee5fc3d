#include "welkin/window/view_command.h"

#include "viewer.h"
#include "welkin/app/commands.h"
#include "welkin/app/places.h"
#include "welkin/app/restore.h"
#include "welkin/app/stop.h"
#include "welkin/core/log.h"
#include "welkin/gpu/timer.h"

namespace welkin::window {
namespace {

Result<app::Restored> startOf(const ViewOptions& options) {
  if (!options.input.empty() && options.viewName.empty()) {
    auto restored = app::restoreFrom(options.input);
    if (restored && restored->result)
      return Error{fmt::format("{}: expected a scene, a picture or a path; a result is dropped onto the window", options.input.string())};
    return restored;
  }
  const bool earth = options.input.empty();
  auto start = app::loadStart(earth ? app::programFolder() / "scenes" / "earth.json" : options.input,
                              earth && options.viewName.empty() ? "orbit" : options.viewName);
  if (!start) return start.error();
  return app::Restored{app::RestoredKind::Scene, std::move(*start), {}, {}};
}

Result<void> view(const ViewOptions& options) {
  auto start = startOf(options);
  if (!start) return start.error();
  app::LoadedSettings loaded = app::loadSettings(app::settingsFile());
  const app::Settings& kept = loaded.settings;
  const Placement place = options.common.size ? Placement{*options.common.size, {}, false}
                                              : Placement{{kept.width, kept.height}, kept.position, kept.maximized};
  auto window = Window::open(place, "Welkin");
  if (!window) return window.error();
  auto context = gpu::Context::ofCurrent();
  if (!context) return Error{context.error().message + "; `welkin render` draws pictures without a window"};
  const auto& device = (*context)->device();
  log::info("OpenGL: {} ({}){}", device.renderer, device.version, device.software ? ", software: no GPU is used" : "");
  if (!loaded.note.empty()) log::warn("{}", loaded.note);
  runViewer(options, std::move(loaded.settings), std::move(*start), **window, **context);
  return {};
}

}  // namespace

void addView(CLI::App& app, app::Action& action) {
  auto o = std::make_shared<ViewOptions>();
  auto* command = app.add_subcommand("view", "open a window and fly; the default without arguments");
  command->footer(
      "Examples:\n  welkin                                        the Earth\n  welkin view scenes/mars.json --size 1280x800\n"
      "  welkin view orbit.png                         back to where a picture was taken\n\nH shows the keys.");
  command->add_option("SCENE", o->input, "a scene or a path (JSON), or a picture (PNG, EXR) of this program; default: scenes/earth.json");
  command->add_option("--view", o->viewName, "which view of the scene");
  app::addQualityOptions(*command, o->common);
  app::addTimeOption(*command, o->common);
  command->add_flag("--quiet,-q", o->common.quiet, "no log lines, only warnings and errors");
  command->add_option("--shots", o->shots, "folder of pictures taken; default: the working folder");
  command->add_option("--state", o->state, "for tests: what the window shows, as JSON, every half second and at the end")->group("");
  command->callback([o, &action] {
    action = [o] {
      app::beginCommand(o->common);
      app::listenForStop();
      o->begun_ms = gpu::wall_ms();
      return view(*o);
    };
  });
}

}  // namespace welkin::window
