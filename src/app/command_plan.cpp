#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "welkin/app/commands.h"
#include "plan_measure.h"
#include "welkin/app/stop.h"
#include "welkin/core/files.h"
#include "welkin/core/progress.h"
#include "welkin/core/units.h"
#include "welkin/physics/scene_time.h"
#include "welkin/render/frame_plan.h"

namespace welkin::app {
namespace {

using Json = nlohmann::ordered_json;

struct PlanOptions {
  CommonOptions common;
  std::filesystem::path input;
  std::string view;
  bool flight = false, measure = false;
  std::vector<std::string> reasons;
  MeasureSettings how;
};

PlanFor askedFor(const Start& start, Size size, bool flight) {
  return {.view = start.view, .onePicture = !flight, .linear = false, .aspect = double(size.width) / size.height};
}

Json sidesJson(const Sides& s) { return {{"left_out", s.leftOut}, {"forced", s.forced}}; }

Json savingJson(const Saving& s) {
  return {{"name", s.reason.name},
          {"asked", s.flight ? "flight" : "picture"},
          {"start_ms", sidesJson(s.start_ms)},
          {"frame_ms", sidesJson(s.frame_ms)},
          {"bytes", sidesJson(s.bytes)},
          {"saved", {{"start", s.start_ms.saved()}, {"frame", s.frame_ms.saved()}, {"bytes", s.bytes.saved()}, {"most", s.most()}}},
          {"max_difference_255", s.maxDifference_255}};
}

// Every reason of the one picture, and those that hold in a flight alone.
Result<std::vector<Saving>> measureAll(const PlanOptions& o, const Start& start, const MeasureSettings& how, Json& out) {
  ::setenv("WELKIN_CACHE", "", 1);  // tables are made, not read
  auto context = gpu::Context::createHeadless(o.common.gpu);
  if (!context) return context.error();
  measure::ReportContext about = describeRun(start.scene, how.size);
  describeDevice(**context, about);
  out["context"] = {{"gl_renderer", about.glRenderer},
                    {"software", about.software},
                    {"width", how.size.width},
                    {"height", how.size.height},
                    {"turns", how.turns},
                    {"frames", how.frames},
                    {"clock", about.software ? "cpu" : "wall"}};
  std::vector<std::pair<PlanFor, LeftOut>> jobs;
  const auto known = [&](const std::string& name) {
    return std::any_of(jobs.begin(), jobs.end(), [&](auto& job) { return job.second.name == name; });
  };
  for (const bool flight : {false, true}) {
    const PlanFor asked = askedFor(start, how.size, flight);
    for (const LeftOut& reason : planFrame(atTime(start.scene, start.time_s), asked).leftOut) {
      const bool wanted = o.reasons.empty() || std::find(o.reasons.begin(), o.reasons.end(), reason.name) != o.reasons.end();
      if (wanted && !known(reason.name)) jobs.emplace_back(asked, reason);
    }
  }
  for (const auto& name : o.reasons)
    if (!known(name)) return Error{fmt::format("{}: nothing is left out for the reason {}", o.input.string(), name)};
  std::vector<Saving> savings;
  Progress progress("plan", o.common.quiet);
  for (const auto& [asked, reason] : jobs) {
    progress.update(double(savings.size()) / double(jobs.size()), reason.name);
    auto saving = measureReason(**context, start, asked, reason, how);
    if (!saving) return saving.error();
    savings.push_back(std::move(*saving));
    if (stopRequested()) return Error{fmt::format("{}: stopped before all was measured", o.input.string())};
  }
  progress.finish();
  return savings;
}

void printSavings(const std::vector<Saving>& savings) {
  fmt::print("saved, with the reason and with it forced not to hold (ms to the first picture, ms a frame, MiB):\n");
  fmt::print("  {:<16} {:<8} {:>22} {:>22} {:>22} {:>11}\n", "reason", "asked", "start", "frame", "memory", "difference");
  for (const Saving& s : savings) {
    const auto cell = [](const Sides& v, double scale) {
      return fmt::format("{:.1f} / {:.1f} {:>4.0f} %", v.leftOut * scale, v.forced * scale, 100 * v.saved());
    };
    fmt::print("  {:<16} {:<8} {:>22} {:>22} {:>22} {:>7}/255\n", s.reason.name, s.flight ? "flight" : "picture", cell(s.start_ms, 1),
               cell(s.frame_ms, 1), cell(s.bytes, 0x1p-20), s.maxDifference_255);
  }
}

Result<void> runPlan(const PlanOptions& o) {
  beginCommand(o.common);
  auto start = loadStart(o.input, o.view);
  if (!start) return start.error();
  apply(o.common, *start);
  const Size size = o.common.size.value_or(o.measure ? Size{320, 180} : start->size);
  if (!o.common.json.empty()) {
    if (auto writable = checkWritableFile(o.common.json); !writable) return writable;
  }
  const FramePlan plan = planFrame(atTime(start->scene, start->time_s), askedFor(*start, size, o.flight));
  Json out{{"scene", o.input.generic_string()},
           {"view", start->viewName},
           {"asked", o.flight ? "flight" : "picture"},
           {"passes", plan.passes},
           {"left_out", Json::array()}};
  for (const auto& left : plan.leftOut) out["left_out"].push_back({{"name", left.name}, {"what", left.what}, {"reason", left.reason}});
  if (!plan.skyModel.empty()) out["sky"] = {{"model", plan.skyModel}, {"reason", plan.skyReason}};
  out["budget_bytes"] = start->scene.quality.budget_bytes;
  fmt::print("runs, in this order:\n");
  for (const auto& pass : plan.passes)
    fmt::print("  {}{}\n", pass, pass == "sky" ? fmt::format(" ({}; {})", plan.skyModel, plan.skyReason) : "");
  fmt::print("left out:{}\n", plan.leftOut.empty() ? " nothing" : "");
  for (const auto& left : plan.leftOut) fmt::print("  {}: {} ({})\n", left.what, left.reason, left.name);
  if (o.measure) {
    listenForStop();
    MeasureSettings how = o.how;
    how.size = size;
    const auto savings = measureAll(o, *start, how, out);
    if (!savings) return savings.error();
    out["measured"] = Json::array();
    for (const Saving& saving : *savings) out["measured"].push_back(savingJson(saving));
    printSavings(*savings);
  }
  if (o.common.json.empty()) return {};
  return writeFile(o.common.json, out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace

void addPlan(CLI::App& app, Action& action) {
  auto o = std::make_shared<PlanOptions>();
  auto* command = app.add_subcommand("plan", "what will run for a view of a scene, what is left out and why");
  command->footer(
      "Examples:\n  welkin plan benchmarks/left-out/no-clouds.json\n"
      "  welkin plan benchmarks/left-out/no-clouds.json --measure   what each reason saves, and that the picture stays");
  command->add_option("SCENE", o->input, "a scene (JSON), or a picture (PNG, EXR) of this program")->required();
  command->add_option("--view", o->view, "which view of the scene");
  command->add_flag("--flight", o->flight, "as a frame of a flight that is at this view (default: one picture, then exit)");
  command->add_flag("--measure", o->measure, "draw with and without each reason, in turns: time, memory, difference");
  command->add_option("--reason", o->reasons, "measure this reason alone (may be repeated)")->check(CLI::IsMember(leftOutReasons()));
  command->add_option("--turns", o->how.turns, "how often each side is measured (default: 3)")->check(CLI::Range(1, 1000));
  command->add_option("--frames", o->how.frames, "frames of each turn after the first picture (default: 8)")->check(CLI::Range(1, 1000));
  addQualityOptions(*command, o->common);
  addTimeOption(*command, o->common);
  addOutputOptions(*command, o->common, "write the plan, and what was measured, to this file");
  command->callback([o, &action] { action = [o] { return runPlan(*o); }; });
}

}  // namespace welkin::app
