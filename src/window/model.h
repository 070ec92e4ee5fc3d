#pragma once
// What the window shows and what its panels may change. The viewer carries out what is wanted between frames.
#include <fmt/format.h>  // before shared headers, whose macro F its templates would meet

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "frame_times.h"
#include "render_scale.h"
#include "welkin/app/fly_camera.h"
#include "welkin/render/renderer.h"

namespace welkin::window {

enum class Panel { Camera, Scene, Quality, Exposure, Time, Profiler, Memory, LeftOut, Log };
inline constexpr std::array<const char*, 9> kPanelNames{"Camera", "Scene", "Quality", "Exposure", "Time", "Profiler", "Memory", "Left out", "Log"};

struct Wanted {  // since the last frame
  bool march = false, air = false, output = false;  // what the renderer changes at once
  bool rebuild = false;                             // what needs a new one
  bool picture = false, convergedPicture = false;
  std::optional<std::filesystem::path> load, saveScene;
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

  RenderScale scale;
  app::Size window, picture;
  FrameStats stats;
  FrameTimes times;
  double frameRate = 0;
  double loading_s = -1;  // for so long a renderer is being made; < 0: none is
  const Renderer* renderer = nullptr;
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
  // Begins anew with this scene and view.
  void start(Scene begun, const View& view);
  void say(const std::string& text, bool bad = false);  // in the window and in the log
};

}  // namespace welkin::window
