#include "welkin/app/options.h"

#include <algorithm>
#include <charconv>
#include <thread>

#include "welkin/app/build_info.h"
#include "welkin/app/checksum.h"
#include "welkin/core/files.h"
#include "welkin/core/log.h"
#include "welkin/physics/path_io.h"
#include "welkin/physics/scene_io.h"

namespace welkin::app {
namespace {

// All of the text as a whole number.
std::optional<int> wholeNumber(std::string_view text) {
  int value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() || text.empty()) return std::nullopt;
  return value;
}

}  // namespace

Result<Size> parseSize(const std::string& text) {
  const auto x = text.find('x');
  if (x != std::string::npos) {
    const auto width = wholeNumber(std::string_view(text).substr(0, x)), height = wholeNumber(std::string_view(text).substr(x + 1));
    const auto fits = [](std::optional<int> v) { return v && *v >= 1 && *v <= kMaxPictureEdge; };
    if (fits(width) && fits(height)) return Size{*width, *height};
  }
  return Error{fmt::format("expected WIDTHxHEIGHT, each 1 to {}, got {}", kMaxPictureEdge, oneLine(text, 60))};
}

Result<Exposure> parseExposure(const std::string& text) {
  if (text == "auto") return Exposure{};
  double ev = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), ev);
  if (parsed.ec == std::errc() && parsed.ptr == text.data() + text.size() && ev >= -40 && ev <= 40) return Exposure{ev};
  return Error{fmt::format("expected auto or stops from -40 to 40, got {}", oneLine(text, 60))};
}

std::string namesText(std::span<const char* const> names) { return fmt::format("{}", fmt::join(names, ", ")); }

Result<std::size_t> findName(std::span<const char* const> names, const std::string& text) {
  const auto found = std::find(names.begin(), names.end(), text);
  if (found != names.end()) return std::size_t(found - names.begin());
  return Error{fmt::format("expected one of: {}, got {}", namesText(names), oneLine(text, 60))};
}

Result<FrameRange> parseRange(const std::string& text) {
  const Error wrong{fmt::format("expected FIRST:END, END not included, either may be empty, got {}", oneLine(text, 60))};
  const auto colon = text.find(':');
  if (colon == std::string::npos) return wrong;
  FrameRange out;
  if (colon > 0) {
    const auto first = wholeNumber(std::string_view(text).substr(0, colon));
    if (!first || *first < 0) return wrong;
    out.first = *first;
  }
  if (colon + 1 < text.size()) {
    out.end = wholeNumber(std::string_view(text).substr(colon + 1));
    if (!out.end || *out.end <= out.first) return wrong;
  }
  return out;
}

Result<std::vector<int>> parseFrameList(const std::string& text) {
  std::vector<int> out;
  for (std::size_t at = 0; at <= text.size();) {
    const auto comma = std::min(text.find(',', at), text.size());
    const auto frame = wholeNumber(std::string_view(text).substr(at, comma - at));
    if (!frame || *frame < 0) return Error{fmt::format("expected frames such as 0,10,20, got {}", oneLine(text, 60))};
    out.push_back(*frame);
    at = comma + 1;
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

void apply(const CommonOptions& options, Scene& scene) {
  auto& q = scene.quality;
  q.budget_bytes = options.budget_bytes.value_or(q.budget_bytes);
  q.depth = options.depth.value_or(q.depth);
  q.step = options.step.value_or(q.step);
  q.integrator = options.integrator.value_or(q.integrator);
  q.stepRule = options.stepRule.value_or(q.stepRule);
  if (options.marchEmpty) q.skipEmpty = false;
  q.spread = options.spread.value_or(q.spread);
  q.detail = options.detail.value_or(q.detail);
  q.seed = options.seed.value_or(q.seed);
  scene.output.toneCurve = options.toneCurve.value_or(scene.output.toneCurve);
  if (!options.exposure) return;
  scene.output.exposure_ev = options.exposure->ev;
  for (auto& [name, view] : scene.views) apply(options, view);
}

void apply(const CommonOptions& options, View& view) {
  if (options.exposure) view.exposure_ev.reset();
}

void apply(const CommonOptions& options, Start& start) {
  apply(options, start.scene);
  apply(options, start.view);
  start.time_s = options.time_s.value_or(start.time_s);
}

Result<Start> loadStart(const std::filesystem::path& file, const std::string& viewName) {
  Start start;
  auto head = readFile(file);
  if (!head) return head.error();
  if (kindOfBytes(*head) != PictureKind::None) {
    auto picture = readPicture(file);
    if (!picture) return picture.error();
    auto state = stateFromTexts(picture->texts, file);
    if (!state) return state.error();
    if (auto found = findData(*state, file); !found) return found.error();
    start.scene = std::move(state->scene);
    start.view = state->view;
    start.size = state->width > 0 ? Size{state->width, state->height}
                                  : std::visit(
                                        [](const auto& image) {
                                          return Size{image.width, image.height};
                                        },
                                        picture->pixels);
    start.notes = std::move(state->notes);
    for (const auto& note : start.notes) log::warn("{}", note);
    start.time_s = state->time_s;
    start.exposure_ev = state->exposure_ev;
    start.debug = state->debug;
    if (viewName.empty()) return start;
  } else {
    auto scene = loadScene(file);
    if (!scene) return scene.error();
    start.scene = std::move(*scene);
  }
  const auto& views = start.scene.views;
  if (views.empty()) return Error{fmt::format("{}: /views: expected at least one view", file.string())};
  start.viewName = !viewName.empty() ? viewName : views.contains("default") ? "default" : views.begin()->first;
  const auto found = views.find(start.viewName);
  if (found == views.end()) {
    std::string names;
    for (const auto& [name, view] : views) names += (names.empty() ? "" : ", ") + oneLine(name, 60);
    return Error{fmt::format("{}: /views: expected one of: {}, got {}", file.string(), names, oneLine(viewName, 60))};
  }
  start.view = found->second;
  return start;
}

measure::ReportContext describeRun(const Scene& scene, Size size) {
  measure::ReportContext c;
  c.date = nowUtc();
  c.build = buildText();
  c.commit = commit();
  c.cpu = cpuName();
  c.cpus = int(std::thread::hardware_concurrency());
  c.scene = scene.file.generic_string();
  for (const auto& [file, sum] : dataChecksums(scene)) c.data[file.filename().string()] = sum;
  c.width = size.width;
  c.height = size.height;
  c.depth = scene.quality.depth;
  c.step = scene.quality.step;
  c.detail = scene.quality.detail;
  c.spread = scene.quality.spread;
  c.integrator = kIntegratorNames[std::size_t(scene.quality.integrator)];
  c.stepRule = kStepRuleNames[std::size_t(scene.quality.stepRule)];
  c.skipEmpty = scene.quality.skipEmpty;
  c.seed = scene.quality.seed;
  c.budget_bytes = scene.quality.budget_bytes;
  return c;
}

}  // namespace welkin::app
