#include "welkin/window/view_command.h"

#include "viewer.h"
#include "welkin/app/commands.h"
#include "welkin/app/stop.h"

namespace welkin::window {

void addView(CLI::App& app, app::Action& action) {
  auto o = std::make_shared<ViewOptions>();
  auto* command = app.add_subcommand("view", "open a window and fly; the default without arguments");
  command->footer(
      "Examples:\n  welkin                                        the Earth\n  welkin view scenes/mars.json --size 1280x800\n"
      "  welkin view orbit.png                         back to where a picture was taken\n\nH shows the keys.");
  command->add_option("SCENE", o->input, "a scene (JSON), or a picture (PNG, EXR) of this program; default: scenes/earth.json");
  command->add_option("--view", o->viewName, "which view of the scene");
  app::addQualityOptions(*command, o->common);
  command->add_flag("--quiet,-q", o->common.quiet, "no log lines, only warnings and errors");
  command->add_option("--shots", o->shots, "folder of pictures taken; default: the working folder");
  command->add_option("--state", o->state, "for tests: what the window shows, as JSON, every half second and at the end")->group("");
  command->callback([o, &action] {
    action = [o] {
      app::beginCommand(o->common);
      app::listenForStop();
      return view(*o);
    };
  });
}

}  // namespace welkin::window
