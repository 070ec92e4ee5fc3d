#include <nlohmann/json.hpp>

#include "commands.h"
#include "welkin/core/files.h"
#include "welkin/render/frame_plan.h"

namespace welkin::app {
namespace {

struct PlanOptions {
  CommonOptions common;
  std::filesystem::path input;
  std::string view;
};

Result<void> runPlan(const PlanOptions& o) {
  beginCommand(o.common);
  auto start = loadStart(o.input, o.view);
  if (!start) return start.error();
  apply(o.common, start->scene);
  apply(o.common, start->view);
  const FramePlan plan = planFrame(start->scene);
  if (!o.common.json.empty()) {
    nlohmann::ordered_json out{{"scene", o.input.generic_string()}, {"passes", plan.passes}, {"left_out", nlohmann::ordered_json::array()}};
    for (const auto& left : plan.leftOut) out["left_out"].push_back({{"what", left.what}, {"reason", left.reason}});
    if (!plan.skyModel.empty()) out["sky"] = {{"model", plan.skyModel}, {"reason", plan.skyReason}};
    out["budget_bytes"] = start->scene.quality.budget_bytes;
    if (auto written = writeFile(o.common.json, out.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n"); !written)
      return written;
  }
  fmt::print("runs, in this order:\n");
  for (const auto& pass : plan.passes)
    fmt::print("  {}{}\n", pass, pass == "sky" ? fmt::format(" ({}; {})", plan.skyModel, plan.skyReason) : "");
  fmt::print("left out:{}\n", plan.leftOut.empty() ? " nothing" : "");
  for (const auto& left : plan.leftOut) fmt::print("  {}: {}\n", left.what, left.reason);
  return {};
}

}  // namespace

void addPlan(CLI::App& app, Action& action) {
  auto o = std::make_shared<PlanOptions>();
  auto* command = app.add_subcommand("plan", "what will run for a scene, what is left out and why");
  command->footer("Example:\n  welkin plan benchmarks/left-out/no-clouds.json");
  command->add_option("SCENE", o->input, "a scene (JSON), or a picture (PNG, EXR) of this program")->required();
  command->add_option("--view", o->view, "which view of the scene");
  addQualityOptions(*command, o->common);
  addOutputOptions(*command, o->common, "write the plan to this file");
  command->callback([o, &action] { action = [o] { return runPlan(*o); }; });
}

}  // namespace welkin::app
