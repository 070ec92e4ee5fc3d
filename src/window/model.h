#pragma once
// What the window shows and what its panels may change. The viewer carries out what is wanted between frames.
#include <fmt/format.h>  // before shared headers, whose macro F its templates would meet

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "frame_times.h"
#include "painter.h"
#include "welkin/app/edit_history.h"
#include "welkin/app/fly_camera.h"
#include "welkin/app/recorder.h"
#include "welkin/app/settings.h"
#include "welkin/render/renderer.h"
#include "welkin/window/render_scale.h"

namespace welkin::window {

enum class Panel { Camera, Scene, Quality, Exposure, Time, Profiler, Memory, LeftOut, Log, Debug };
inline constexpr std::array<const char*, 10> kPanelNames{"Camera",   "Scene",  "Quality",  "Exposure", "Time",
                                                        "Profiler", "Memory", "Left out", "Log",   "Debug"};

struct Wanted {                                     // since the last frame
  bool march = false, air = false, output = false;  // what the renderer changes at once
  bool rebuild = false;                             // what needs a new one
  bool picture = false, convergedPicture = false;
  bool saveScene = false, savePath = false;
};

struct Model {
  Scene scene, asLoaded;
  std::string viewName;
  app::FlyCamera camera{6'371'000};
  View home;                          // where it began
  std::optional<double> exposure_ev;  // of the picture; none: metered
  double time_s = 0, timeSpeed = 1;
  bool playing = false;
  bool reprojection = true;
  DebugView debug = DebugView::None;

  app::Settings settings;
  bool settingsChanged = false;
  enum class Tape { Idle, Recording, Replaying };
  Tape tape = Tape::Idle;
  app::Recording recording;
  double tape_s = 0;  // since the recording, or the replay, began

  RenderScale scale;
  app::Size window, picture;
  FrameStats stats;
  FrameTimes times;
  double frameRate = 0;
  double loading_s = -1;  // for so long a renderer is being made; < 0: none is
  std::optional<Painted> painted;  // the last picture
  std::string device;
  bool software = false;

  bool sidebar = true, help = false;
  std::array<bool, kPanelNames.size()> open{true};
  std::optional<Panel> showNow;  // scroll to it
  std::string message;           // the newest, shown for some seconds
  bool messageBad = false;
  double messageUntil_s = 0;
  Wanted wanted;

  View view() const {
    View v = camera.view();
    v.exposure_ev = exposure_ev;
    return v;
  }
  app::EditHistory<Scene> edits{Scene{}};
  void runTape(double dt_s);  // a recording or a replay goes on
  void keepEdits();           // what is finished can be undone
  void undo();
  void redo();
  // Begins anew with this scene and view.
  void start(Scene begun, const View& view);
  void show(const Scene& other);  // an earlier or later state of this one

  void say(const std::string& text, bool bad = false);  // in the window and in the log
};

}  // namespace welkin::window
