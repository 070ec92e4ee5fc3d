// Which settings a sweep is made of.
#include <algorithm>
#include <charconv>
#include <functional>

#include "welkin/app/converge.h"
#include "welkin/core/files.h"
#include "welkin/core/units.h"
#include "welkin/physics/scene_io.h"

namespace welkin::app {
namespace {

using measure::ConvergeSetting;

Result<double> number(const std::string& text, double low, double high) {
  double value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec == std::errc() && parsed.ptr == text.data() + text.size() && value >= low && value <= high) return value;
  return Error{fmt::format("expected a number from {} to {}, got {}", low, high, oneLine(text, 60))};
}

// Puts one value of an axis into a setting.
Result<void> set(ConvergeSetting& s, const std::string& axis, const std::string& text) {
  const auto into = [](auto& target, const auto& value) -> Result<void> {
    if (!value) return value.error();
    target = std::decay_t<decltype(target)>(*value);
    return {};
  };
  Quality& q = s.quality;
  if (axis == "step") return into(q.step, number(text, 1e-6, 1000));
  if (axis == "integrator") return into(q.integrator, findName(kIntegratorNames, text));
  if (axis == "step-rule") return into(q.stepRule, findName(kStepRuleNames, text));
  if (axis == "spread") return into(q.spread, number(text, 0, 255));
  if (axis == "detail") return into(q.detail, number(text, 0, 1e6));
  if (axis == "frames") return into(s.frames, findName(measure::kFramesNames, text));
  if (axis == "light") return into(s.light, number(text, 0.25, 8));
  if (axis == "budget") {
    const auto bytes = parseBytes(text);
    if (bytes && (*bytes < kMinBudget_bytes || *bytes > kMaxBudget_bytes)) return Error{"expected 1MiB to 1024GiB"};
    return into(q.budget_bytes, bytes);
  }
  const auto whole = number(text, 0, 1000);
  if (!whole || *whole != std::floor(*whole)) return Error{fmt::format("expected a whole number, got {}", oneLine(text, 60))};
  if (axis == "depth" && (*whole < 1 || *whole > 24)) return Error{"expected a depth from 1 to 24"};
  if (axis == "brick-bits" && *whole != 8 && *whole != 16) return Error{"expected 8 or 16 bits"};
  if (axis == "skip-empty" && *whole > 1) return Error{"expected 0 or 1"};
  if (axis == "depth") q.depth = int(*whole);
  if (axis == "brick-bits") s.brickBits = int(*whole);
  if (axis == "skip-empty") q.skipEmpty = *whole != 0;
  return {};
}

// How a setting is told from the base; integrator, rule and step always.
std::vector<std::pair<std::string, std::string>> parts(const ConvergeSetting& s, const ConvergeSetting& base) {
  const Quality &q = s.quality, &b = base.quality;
  std::vector<std::pair<std::string, std::string>> out{{"integrator", kIntegratorNames[std::size_t(q.integrator)]},
                                                       {"step-rule", kStepRuleNames[std::size_t(q.stepRule)]},
                                                       {"step", fmt::format("{:g}", q.step)}};
  const auto differs = [&](bool yes, const char* axis, std::string text) {
    if (yes) out.emplace_back(axis, std::move(text));
  };
  differs(q.skipEmpty != b.skipEmpty, "skip-empty", q.skipEmpty ? "empty nodes skipped" : "empty nodes marched");
  differs(q.budget_bytes != b.budget_bytes, "budget", bytesText(q.budget_bytes));
  differs(q.depth != b.depth, "depth", fmt::format("depth {}", q.depth));
  differs(q.spread != b.spread, "spread", fmt::format("spread {:g}", q.spread));
  differs(q.detail != b.detail, "detail", fmt::format("detail {:g}", q.detail));
  differs(s.frames != base.frames, "frames", fmt::format("one in 16, {}", measure::kFramesNames[std::size_t(s.frames)]));
  differs(s.brickBits != base.brickBits, "brick-bits", fmt::format("{} bits", s.brickBits));
  differs(s.light != base.light, "light", fmt::format("light {:g}", s.light));
  return out;
}

std::string text(const std::vector<std::pair<std::string, std::string>>& parts, const std::string& without) {
  std::string out;
  for (const auto& [axis, part] : parts) {
    if (axis == without) continue;
    const bool word = axis == "integrator" || axis == "step-rule" || axis == "step";
    out += (out.empty() ? "" : word ? " " : ", ") + part;
  }
  return out;
}

}  // namespace

Result<SweepAxis> parseSweep(const std::string& given) {
  const auto equals = given.find('=');
  SweepAxis axis{given.substr(0, equals), {}};
  if (equals == std::string::npos) return Error{fmt::format("expected AXIS=VALUE,VALUE..., got {}", oneLine(given, 60))};
  if (const auto known = findName(kSweepAxes, axis.name); !known) return known.error();
  for (std::size_t at = equals + 1; at <= given.size();) {
    const auto comma = std::min(given.find(',', at), given.size());
    axis.values.push_back(given.substr(at, comma - at));
    ConvergeSetting scratch;
    if (auto read = set(scratch, axis.name, axis.values.back()); !read)
      return Error{fmt::format("{}: {}", axis.name, read.error().message)};
    at = comma + 1;
  }
  return axis;
}

std::vector<ConvergeSetting> combine(const ConvergeSetting& base, const std::vector<SweepAxis>& axes) {
  std::vector<ConvergeSetting> out{base};
  std::string line = axes.empty() ? "step" : axes.back().name;
  for (const auto& axis : axes) {
    if (axis.name == "step") line = "step";
    std::vector<ConvergeSetting> more;
    for (const auto& setting : out) {
      for (const auto& value : axis.values) {
        more.push_back(setting);
        if (!set(more.back(), axis.name, value)) more.pop_back();  // parseSweep has read it before
      }
    }
    out = std::move(more);
  }
  for (auto& setting : out) {
    const auto all = parts(setting, base);
    setting.name = text(all, "");
    setting.series = {line == "step" ? text(all, line) : line + ": " + text(all, line)};
  }
  return out;
}

void merge(std::vector<ConvergeSetting>& settings, const std::vector<ConvergeSetting>& more) {
  for (const auto& setting : more) {
    const auto same = std::find_if(settings.begin(), settings.end(), [&](const auto& s) { return s.name == setting.name; });
    if (same == settings.end()) {
      settings.push_back(setting);
      continue;
    }
    for (const auto& series : setting.series)
      if (std::find(same->series.begin(), same->series.end(), series) == same->series.end()) same->series.push_back(series);
  }
}

std::vector<ConvergeSetting> presetSettings(const std::string& preset, const ConvergeSetting& base) {
  const std::uint64_t budget = base.quality.budget_bytes;
  const SweepAxis steps{"step", {"2.56", "1.28", "0.64", "0.32", "0.16", "0.08"}};
  SweepAxis integrators{"integrator", {}}, rules{"step-rule", {}}, budgets{"budget", {}};
  for (const char* name : kIntegratorNames) integrators.values.emplace_back(name);
  for (const char* name : kStepRuleNames) rules.values.emplace_back(name);
  for (const std::uint64_t part : {1, 2, 4}) budgets.values.push_back(bytesExact(budget / part));
  std::vector<ConvergeSetting> out;
  if (preset == "quick")
    merge(out, combine(base, {{"integrator", {"rectangle", "exponential-linear"}}, {"step", {"1.28", "0.64", "0.32"}}}));
  if (preset == "default") {
    merge(out, combine(base, {integrators, steps}));
    merge(out, combine(base, {budgets}));
  }
  if (preset == "rules") merge(out, combine(base, {rules, steps}));
  if (preset == "detail") {
    merge(out, combine(base, {{"depth", {"9", "10", "11", "12", "13"}}}));
    merge(out, combine(base, {{"detail", {"6", "12", "24", "48", "0"}}}));
  }
  if (preset == "frames") merge(out, combine(base, {{"frames", {"full", "still", "moving"}}, {"step", {"0.64", "0.32", "0.16"}}}));
  if (preset == "bricks") merge(out, combine(base, {{"brick-bits", {"16", "8"}}, {"step", {"0.64", "0.32", "0.16"}}}));
  if (preset == "light") merge(out, combine(base, {{"light", {"0.5", "1", "2", "4"}}}));
  return out;
}

}  // namespace welkin::app
