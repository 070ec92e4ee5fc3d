#include "converge_rows.h"

#include <algorithm>

#include "welkin/app/picture.h"

namespace welkin::app {

using measure::ConvergeRow, measure::ConvergeSetting;

namespace {
constexpr std::size_t kFromFront = 4;  // pictures of differences, evenly along the front
}

void addTimes(MeasuredSetting& work, const FrameStats& stats, bool software) {
  double sum = 0;
  for (const auto& [name, time] : stats.passes) {
    const double ms = software ? time.cpu_ms : time.wall_ms;
    work.passes_ms[name].push_back(ms);
    sum += ms;
  }
  work.time_ms.push_back(sum);
}

ConvergeRow rowOf(const ConvergeSetting& setting, const MeasuredSetting& work, const FrameStats& settled, bool software) {
  ConvergeRow out;
  out.setting = setting;
  out.time_ms = measure::spreadOf(work.time_ms);
  for (const auto& [name, times] : work.passes_ms) out.passes_ms[name] = measure::spreadOf(times);
  out.bytes = work.stats.bytesUsed;
  out.samples = work.stats.counters.samples;
  out.cells = work.stats.counters.cells;
  out.residency = work.stats.residency;
  out.settle_ms = software ? settled.cpu_ms : settled.wall_ms;
  if (const auto light = settled.passes.find("light"); light != settled.passes.end())
    out.light_ms = software ? light->second.cpu_ms : light->second.wall_ms;
  out.error = measure::joined(work.errors);
  return out;
}

void addBest(std::vector<ConvergeRow>& rows, const std::vector<MeasuredSetting>& measured) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Quality& q = rows[i].setting.quality;
    std::size_t best = i;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Quality &other = rows[k].setting.quality, &b = rows[best].setting.quality;
      if (other.integrator != q.integrator || other.stepRule != q.stepRule || other.skipEmpty != q.skipEmpty) continue;
      const bool finer = other.budget_bytes != b.budget_bytes ? other.budget_bytes > b.budget_bytes : other.step < b.step;
      if (finer) best = k;
    }
    std::vector<measure::ImageError> errors;
    for (std::size_t pose = 0; pose < measured[i].pictures.size(); ++pose)
      if (auto error = measure::compare(measured[best].pictures[pose], measured[i].pictures[pose])) errors.push_back(*error);
    rows[i].best_rmse_255 = measure::joined(errors).rmse_255;
  }
}

void addPictures(measure::ConvergeReport& out, const std::vector<MeasuredSetting>& measured, const Image8& truth) {
  if (auto png = pngBytes(truth, {})) out.pictures.push_back({"truth", out.truth.description, *png});
  std::vector<std::string> names;
  const auto add = [&names](const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  const auto front = measure::paretoFront(out.rows);
  const auto worst =
      std::max_element(out.rows.begin(), out.rows.end(), [](const auto& a, const auto& b) { return a.error.rmse_255 < b.error.rmse_255; });
  if (worst != out.rows.end()) add(worst->setting.name);
  for (std::size_t i = 0; i < kFromFront && !front.empty(); ++i) add(front[i * (front.size() - 1) / (kFromFront - 1)]);
  for (const auto& name : names) {
    for (std::size_t i = 0; i < out.rows.size(); ++i) {
      if (out.rows[i].setting.name != name) continue;
      const auto& r = out.rows[i];
      if (auto png = pngBytes(measured[i].difference, {}))
        out.pictures.push_back({name,
                                fmt::format("RMSE {:.3f}, {:.1f} ms; black: none, palest: {:g}/255 and more", r.error.rmse_255,
                                            r.time_ms.median, kShowFull_255),
                                *png});
    }
  }
}

}  // namespace welkin::app
