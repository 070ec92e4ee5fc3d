#pragma once
// What commands share: sizes, ranges, the common options, and the scene or picture that they start from.
#include <fmt/format.h>  // before shared headers, whose macro F its templates would meet

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "welkin/app/picture.h"
#include "welkin/core/result.h"
#include "welkin/measure/timings.h"
#include "welkin/physics/scene.h"

namespace welkin::app {

struct Size {
  int width = 1280, height = 720;
};
Result<Size> parseSize(const std::string& text);  // "1280x720", 1..16384 each

struct Exposure {
  std::optional<double> ev;  // none: metered
};
Result<Exposure> parseExposure(const std::string& text);    // "auto", or stops from -40 to 40
std::string namesText(std::span<const char* const> names);  // "aces, reinhard, ..."
Result<std::size_t> findName(std::span<const char* const> names, const std::string& text);
// Reads one of the names of an enumeration that counts from 0.
template <class E>
auto parseName(std::span<const char* const> names) {
  return [names](const std::string& text) -> Result<E> {
    const auto found = findName(names, text);
    if (!found) return found.error();
    return E(*found);
  };
}

struct FrameRange {  // first, and one past the last; the end may be open
  int first = 0;
  std::optional<int> end;
};
Result<FrameRange> parseRange(const std::string& text);            // "A:B", "A:", ":B"
Result<std::vector<int>> parseFrameList(const std::string& text);  // "0,10,20": ascending, without repeats

// Options as given; what is absent leaves the scene's own value.
struct CommonOptions {
  std::optional<Size> size;
  std::optional<std::uint64_t> budget_bytes;
  std::optional<int> depth;
  std::optional<Integrator> integrator;
  std::optional<StepRule> stepRule;
  bool marchEmpty = false;
  std::optional<double> tolerance_255;  // in place of step, spread and detail: error of the picture, RMSE on 0..255 (measure/tolerance.h)
  std::optional<double> step, spread, detail;
  std::optional<std::uint32_t> seed;
  std::optional<Exposure> exposure;  // in place of the scene's and of every view's
  std::optional<ToneCurve> toneCurve;
  std::optional<double> time_s;  // of the scene
  std::string gpu = "auto";
  bool quiet = false;
  std::filesystem::path json;
};
void apply(const CommonOptions& options, Scene& scene);
void apply(const CommonOptions& options, View& view);

// What `render` and `plan` start from: a scene file with one of its views, or a picture with the view it shows.
struct Start {
  Scene scene;
  View view;
  std::string viewName;
  Size size;
  double time_s = 0;
  std::optional<double> exposure_ev;  // of a picture
  std::optional<DebugView> debug;     // that a picture shows; commands draw what their own option says
  std::vector<std::string> notes;     // of a picture: what it did not say; logged already
};
void apply(const CommonOptions& options, Start& start);  // but for the size
// `viewName` empty: the only view, or "default", or the first one by name; a picture's own. The error names the views that are there.
Result<Start> loadStart(const std::filesystem::path& file, const std::string& viewName);

// Context of reports, but for what the GL tells.
measure::ReportContext describeRun(const Scene& scene, Size size);

}  // namespace welkin::app
