#include "welkin/measure/timings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report_json.h"
#include "welkin/core/units.h"
#include "welkin/measure/debug_json.h"

namespace welkin::measure {
namespace {

using Json = nlohmann::ordered_json;

Json asJson(const Summary& s) { return {{"median_ms", s.median}, {"p95_ms", s.p95}, {"max_ms", s.max}, {"mean_ms", s.mean}, {"n", s.n}}; }

template <class Get>
Summary over(const std::vector<FrameRow>& frames, Get get) {
  std::vector<double> values;
  for (const auto& row : frames) values.push_back(get(row.stats));
  return summarize(values);
}

}  // namespace

Json contextJson(const ReportContext& c) {
  Json out;
  const auto text = [&](const char* key, const std::string& value) {
    if (!value.empty()) out[key] = value;
  };
  text("date", c.date);
  out["executable"] = "welkin";
  out["num_cpus"] = c.cpus;
  text("library_build_type", c.build.find("Debug") != std::string::npos ? "debug" : "release");
  text("build", c.build);
  text("commit", c.commit);
  text("cpu", c.cpu);
  text("gl_renderer", c.glRenderer);
  text("gl_version", c.glVersion);
  text("gl_vendor", c.glVendor);
  out["software"] = c.software;
  out["timer"] = c.software ? "glFinish and clocks" : "GL timestamp queries";
  text("scene", c.scene);
  text("path", c.path);
  text("command", c.command);
  if (!c.data.empty()) out["data"] = c.data;
  out["settings"] = {{"width", c.width},
                     {"height", c.height},
                     {"budget_bytes", c.budget_bytes},
                     {"depth", c.depth},
                     {"step", c.step},
                     {"detail", c.detail},
                     {"seed", c.seed},
                     {"bricks_per_frame", c.bricksPerFrame},
                     {"deterministic", c.deterministic}};
  if (!c.integrator.empty()) {
    out["settings"]["integrator"] = c.integrator;
    out["settings"]["step_rule"] = c.stepRule;
    out["settings"]["skip_empty"] = c.skipEmpty;
    out["settings"]["spread"] = c.spread;
  }
  return out;
}

namespace {

Json countersJson(const FrameCounters& c) {
  return {{"nan_pixels", c.nanPixels},           {"holes", c.holes}, {"marched_pixels", c.marchedPixels},
          {"rejected_pixels", c.rejectedPixels}, {"cells", c.cells}, {"samples", c.samples}};
}

Json residencyJson(const FrameStats& s) {
  const auto& r = s.residency;
  Json levels = Json::array();
  int deepest = 0;
  for (int i = 0; i < int(std::size(r.bricksByLevel)); ++i) deepest = r.bricksByLevel[i] ? i : deepest;
  for (int i = 0; i <= deepest; ++i) levels.push_back(r.bricksByLevel[i]);
  return {{"nodes", r.nodes},          {"groups", r.groups},
          {"bricks", r.bricks},        {"brick_capacity", r.brickCapacity},
          {"empty", r.emptyNodes},     {"pending_bricks", r.pendingBricks},
          {"bricks_by_level", levels}, {"bytes", s.bytesUsed},
          {"budget", s.bytesBudget},   {"frame_target_bytes", s.frameTargetBytes},
          {"cpu_bytes", r.cpuBytes},   {"settled", r.settled}};
}

Json frameJson(const FrameRow& row) {
  const auto& s = row.stats;
  Json out{{"frame", row.pathFrame}, {"time_s", row.time_s}, {"altitude_m", row.altitude_m},
           {"wall_ms", s.wall_ms},   {"cpu_ms", s.cpu_ms},   {"wait_ms", s.wait_ms}};
  for (const auto& [name, time] : s.passes) out["passes"][name] = {{"wall_ms", time.wall_ms}, {"cpu_ms", time.cpu_ms}};
  out["counters"] = countersJson(s.counters);
  out["bricks"] = s.residency.bricks;
  out["nodes"] = s.residency.nodes;
  out["pending_bricks"] = s.residency.pendingBricks;
  out["bricks_generated"] = s.bricksGenerated;
  out["bricks_lit"] = s.bricksLit;
  out["light_stale_deg"] = s.lightStale_deg;
  out["bytes"] = s.bytesUsed;
  out["cpu_bytes"] = s.residency.cpuBytes;
  out["sample_detail"] = s.sampleDetail;
  out["exposure_ev"] = s.exposure_ev;
  if (!s.leftOut.empty()) out["left_out"] = s.leftOut;
  if (!row.picture.empty()) out["picture"] = row.picture;
  return out;
}

Json benchmarkJson(const std::string& name, const Summary& wall, const Summary& cpu) {
  return {{"name", name}, {"run_name", name},     {"run_type", "iteration"},  {"repetitions", 1},       {"repetition_index", 0},
          {"threads", 1}, {"iterations", wall.n}, {"real_time", wall.median}, {"cpu_time", cpu.median}, {"time_unit", "ms"}};
}

Json errorJson(const ImageError& e) {
  Json out{{"rmse_255", e.rmse_255}, {"p99_255", e.p99_255},         {"p999_255", e.p999_255},       {"max_255", e.max_255},
           {"mean_255", e.mean_255}, {"share_over_1", e.shareOver1}, {"share_over_2", e.shareOver2}, {"share_over_16", e.shareOver16}};
  if (std::isfinite(e.psnr_db)) out["psnr_db"] = e.psnr_db;
  return out;
}

}  // namespace

std::uint64_t TimingReport::nanPixels() const {
  std::uint64_t n = 0;
  for (const auto& row : frames) n += row.stats.counters.nanPixels;
  return n;
}
std::uint64_t TimingReport::holes() const {
  std::uint64_t n = 0;
  for (const auto& row : frames) n += row.stats.counters.holes;
  return n;
}
std::uint64_t TimingReport::greatestBytes() const {
  std::uint64_t n = 0;
  for (const auto& row : frames) n = std::max(n, row.stats.bytesUsed);
  return n;
}

std::vector<PassRow> TimingReport::passes() const {
  std::vector<std::string> names = passOrder;
  std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> times;
  for (const auto& row : frames) {
    for (const auto& [pass, time] : row.stats.passes) {
      if (std::find(names.begin(), names.end(), pass) == names.end()) names.push_back(pass);
      times[pass].first.push_back(time.wall_ms);
      times[pass].second.push_back(time.cpu_ms);
    }
  }
  std::vector<PassRow> out;
  double all = 0;
  for (const auto& pass : names) {
    const auto found = times.find(pass);
    if (found == times.end()) continue;  // planned, but it never ran
    out.push_back({pass, summarize(found->second.first), summarize(found->second.second), 0});
    all += out.back().wall_ms.total;
  }
  for (auto& row : out) row.share = all > 0 ? row.wall_ms.total / all : 0;
  return out;
}

namespace {

Json choiceJson(const ToleranceRow& row) {
  const Quality& q = row.choice.quality;
  Json out{{"settings",
            {{"integrator", kIntegratorNames[std::size_t(q.integrator)]},
             {"step_rule", kStepRuleNames[std::size_t(q.stepRule)]},
             {"step", q.step},
             {"spread", q.spread},
             {"detail", q.detail}}},
           {"kept", row.choice.kept},
           {"estimate_rmse_255", row.choice.estimate_255},
           {"finest_rmse_255", row.choice.finest_255},
           {"cost", row.choice.cost},
           {"candidates_drawn", row.choice.tried},
           {"pixels", row.choice.pixels}};
  if (row.reached_255) out["reached_rmse_255"] = *row.reached_255;
  return out;
}

// The newest choice, and all of them where a flight made several.
Json toleranceJson(double asked_255, const std::vector<ToleranceRow>& rows) {
  Json out{{"asked", asked_255}};
  if (rows.empty()) return out;
  out.update(choiceJson(rows.back()));
  if (rows.size() < 2) return out;
  for (const auto& row : rows) {
    Json entry = choiceJson(row);
    entry["frame"] = row.pathFrame;
    out["choices"].push_back(std::move(entry));
  }
  return out;
}

}  // namespace

std::string TimingReport::json() const {
  Json out;
  out["context"] = contextJson(context);
  out["benchmarks"] = Json::array();
  const Summary wall = over(frames, [](const FrameStats& s) { return s.wall_ms; });
  const Summary cpu = over(frames, [](const FrameStats& s) { return s.cpu_ms; });
  const auto rows = passes();
  for (const auto& pass : rows) out["benchmarks"].push_back(benchmarkJson(name + "/" + pass.name, pass.wall_ms, pass.cpu_ms));
  out["benchmarks"].push_back(benchmarkJson(name + "/frame", wall, cpu));
  out["passes"] = Json::object();
  for (const auto& pass : rows) {
    out["passes"][pass.name] = asJson(pass.wall_ms);
    out["passes"][pass.name]["share"] = pass.share;
    out["passes"][pass.name]["cpu_ms"] = asJson(pass.cpu_ms);
  }
  out["frame_ms"] = asJson(wall);
  out["cpu_ms"] = asJson(cpu);
  out["wait_ms"] = asJson(over(frames, [](const FrameStats& s) { return s.wait_ms; }));
  out["wait_ms"]["total_ms"] = over(frames, [](const FrameStats& s) { return s.wait_ms; }).total;
  if (!frames.empty()) {
    out["residency"] = residencyJson(frames.back().stats);
    out["residency"]["greatest_bytes"] = greatestBytes();
    out["residency"]["budget_kept"] =
        std::all_of(frames.begin(), frames.end(), [](const FrameRow& r) { return r.stats.bytesUsed <= r.stats.bytesBudget; });
    out["residency"]["by_name"] = memoryByName;
  }
  FrameCounters sum;
  std::uint64_t generated = 0, lit = 0;
  for (const auto& row : frames) {
    const auto& c = row.stats.counters;
    sum.nanPixels += c.nanPixels, sum.holes += c.holes, sum.marchedPixels += c.marchedPixels, sum.rejectedPixels += c.rejectedPixels;
    sum.cells += c.cells, sum.samples += c.samples;
    generated += row.stats.bricksGenerated, lit += row.stats.bricksLit;
  }
  out["counters"] = countersJson(sum);
  out["counters"]["bricks_generated"] = generated;
  out["counters"]["bricks_lit"] = lit;
  out["nan_pixels"] = sum.nanPixels;
  out["holes"] = sum.holes;
  out["gl_debug_messages"] = glMessages;
  if (!glFirstMessages.empty()) out["gl_first_messages"] = glFirstMessages;
  out["left_out"] = Json::array();
  for (const auto& left : leftOut) out["left_out"].push_back({{"name", left.name}, {"what", left.what}, {"reason", left.reason}});
  if (!quality.empty()) {
    std::vector<double> rmse;
    for (const auto& row : quality) {
      Json one{{"frame", row.pathFrame}};
      one.update(errorJson(row.error));
      out["quality"]["frames"].push_back(one);
      rmse.push_back(row.error.rmse_255);
    }
    const Summary s = summarize(rmse);
    out["quality"]["against"] = "the same pose converged, every pixel marched";
    out["quality"]["rmse_255"] = {{"median", s.median}, {"max", s.max}, {"n", s.n}};
  }
  if (!pops.empty()) {
    double p999 = 0, mean = 0;
    for (const auto& pop : pops) {
      p999 = std::max(p999, pop.p999_255), mean = std::max(mean, pop.mean_255);
      out["pop"]["frames"].push_back(
          {{"frame", pop.pathFrame}, {"p999_255", pop.p999_255}, {"mean_255", pop.mean_255}, {"max_255", pop.max_255}});
    }
    out["pop"]["p999_255"] = p999;
    out["pop"]["largest_mean_255"] = mean;
  }
  if (!notes.empty()) out["notes"] = notes;
  if (debug) out["debug"] = Json::parse(debugJson(*debug));
  if (time_ms) out["time_ms"] = *time_ms;
  if (tolerance_255) out["tolerance"] = toleranceJson(*tolerance_255, tolerance);
  out["total_s"] = total_s;
  out["stopped"] = stopped;
  out["frames"] = Json::array();
  for (const auto& row : frames) out["frames"].push_back(frameJson(row));
  return out.dump(1, ' ', false, Json::error_handler_t::replace);
}

std::string TimingReport::table() const {
  const auto rows = passes();
  std::size_t width = 5;
  for (const auto& row : rows) width = std::max(width, row.name.size());
  std::string out = fmt::format("{:<{}}  {:>10}  {:>10}  {:>6}\n", "pass", width, "median ms", "p95 ms", "share");
  for (const auto& row : rows) {
    out += fmt::format("{:<{}}  {:>10.3f}  {:>10.3f}  {:>5.1f}%\n", row.name, width, row.wall_ms.median, row.wall_ms.p95, 100 * row.share);
  }
  const Summary wall = over(frames, [](const FrameStats& s) { return s.wall_ms; });
  out += fmt::format("{:<{}}  {:>10.3f}  {:>10.3f}\n", "frame", width, wall.median, wall.p95);
  return out;
}

}  // namespace welkin::measure
