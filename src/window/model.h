#pragma once
// What the window shows and what its panels may change. The viewer carries out what is wanted between frames.
#include <fmt/format.h>  // before shared headers, whose macro F its templates would meet

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "deck.h"
#include "flight_job.h"
#include "frame_times.h"
#include "painter.h"
#include "welkin/app/edit_history.h"
#include "welkin/app/fly_camera.h"
#include "welkin/app/settings.h"
#include "welkin/render/renderer.h"
#include "welkin/window/render_scale.h"

namespace welkin::window {

enum class Panel { Camera, Scene, Quality, Exposure, Time, Profiler, Memory, LeftOut, Log, Debug, Flight, Results };
inline constexpr std::array<const char*, 12> kPanelNames{"Camera", "Scene",    "Quality", "Exposure", "Time",   "Profiler",
                                                         "Memory", "Left out", "Log",     "Debug",    "Flight", "Results"};
inline constexpr std::array<char, kPanelNames.size()> kPanelKeys{'1', '2', '3', '4', '5', '6', '7', '8', '9', '0', 'F', 'B'};

struct Wanted {                                     // since the last frame
  bool march = false, air = false, output = false;  // what the renderer changes at once
  bool rebuild = false;                             // what needs a new one
  bool picture = false, convergedPicture = false;
  bool saveScene = false, savePath = false;
  bool endRecording = false, stopFlight = false;
  std::optional<FlightTask> flight;  // of the tape, as `welkin fly` would
};

struct Results {  // of flights: measured in this window, or dropped onto it
  std::vector<app::FlightResult> all;
  int a = -1, b = -1;  // side by side; -1: none
  void add(app::FlightResult result);
};

struct Model {
  Scene scene, asLoaded;
  std::string viewName;
  app::FlyCamera camera{6'371'000};
  View home;                          // where it began
  std::optional<double> exposure_ev;  // of the picture; none: metered
  bool timeMoves() const;  // the scene has a day, or a wind
  double time_s = 0, timeSpeed = 1;
  bool playing = false;
  bool reprojection = true;
  DebugView debug = DebugView::None;

  app::Settings settings;
  bool settingsChanged = false;
  Deck deck;
  Results results;
  struct Flight {
    FlightTask task;
    FlightJob::Progress progress;
    bool stopping;
  };
  std::optional<Flight> flight;  // that is replayed just now as `welkin fly` does

  RenderScale scale;
  app::Size window, picture;
  FrameStats stats;
  FrameTimes times;
  double frameRate = 0;
  double loading_s = -1;           // for so long a renderer is being made; < 0: none is
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
  void show(const PathFrame& frame);
  void showResult(app::FlightResult result);
  void keepEdits();  // what is finished can be undone
  void undo();
  void redo();
  // Begins anew with this scene and view.
  void start(Scene begun, const View& view);
  void show(const Scene& other);  // an earlier or later state of this one

  void say(const std::string& text, bool bad = false);  // in the window and in the log
};

}  // namespace welkin::window
