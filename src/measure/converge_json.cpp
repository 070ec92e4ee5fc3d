#include <cmath>

#include "report_json.h"
#include "welkin/measure/converge.h"

namespace welkin::measure {
namespace {

using Json = nlohmann::ordered_json;

Json spreadJson(const Spread& s) { return {{"median", s.median}, {"p25", s.p25}, {"p75", s.p75}, {"n", s.n}}; }

Json rowJson(const ConvergeRow& row) {
  const auto& s = row.setting;
  const auto& e = row.error;
  const auto& r = row.residency;
  Json out{{"name", s.name},
           {"series", s.series},
           {"integrator", kIntegratorNames[std::size_t(s.quality.integrator)]},
           {"step_rule", kStepRuleNames[std::size_t(s.quality.stepRule)]},
           {"step", s.quality.step},
           {"skip_empty", s.quality.skipEmpty},
           {"spread", s.quality.spread},
           {"budget_bytes", s.quality.budget_bytes},
           {"depth", s.quality.depth},
           {"detail", s.quality.detail},
           {"frames", kFramesNames[std::size_t(s.frames)]},
           {"brick_bits", s.brickBits},
           {"light", s.light},
           {"time_ms", row.time_ms.median},
           {"time_spread_ms", spreadJson(row.time_ms)},
           {"passes", Json::object()}};
  for (const auto& [name, time] : row.passes_ms) out["passes"][name] = spreadJson(time);
  out["bytes"] = row.bytes;
  out["samples"] = row.samples;
  out["cells"] = row.cells;
  out["settle_ms"] = row.settle_ms;
  out["light_ms"] = row.light_ms;
  Json levels = Json::array();
  int deepest = 0;
  for (int i = 0; i < int(std::size(r.bricksByLevel)); ++i) deepest = r.bricksByLevel[i] ? i : deepest;
  for (int i = 0; i <= deepest; ++i) levels.push_back(r.bricksByLevel[i]);
  out["residency"] = {{"nodes", r.nodes},
                      {"bricks", r.bricks},
                      {"brick_capacity", r.brickCapacity},
                      {"empty", r.emptyNodes},
                      {"pending_bricks", r.pendingBricks},
                      {"selected_detail", r.selectedDetail},
                      {"bricks_by_level", levels},
                      {"settled", r.settled}};
  out["error"] = {{"rmse_255", e.rmse_255},   {"relative_rmse", e.relativeRmse}, {"p99_255", e.p99_255},
                  {"max_255", e.max_255},     {"over_2_share", e.shareOver2},    {"flip", e.flip},
                  {"not_finite", e.notFinite}};
  if (row.best_rmse_255) out["error"]["rmse_255_of_best"] = *row.best_rmse_255;
  return out;
}

}  // namespace

std::string ConvergeReport::json() const {
  Json out{{"context", contextJson(context)}};
  out["context"]["view"] = view;
  out["context"]["poses"] = poses;
  out["context"]["repetitions"] = repetitions;
  out["context"]["time_ms"] = clock;
  out["truth"] = {{"kind", truth.kind}, {"tolerance", truth.tolerance_255}, {"description", truth.description}};
  out["settings"] = Json::array();
  for (const auto& row : rows) out["settings"].push_back(rowJson(row));
  out["pareto"] = paretoFront(rows);
  out["orders"] = Json::array();
  for (const auto& order : observedOrders(rows, truth.tolerance_255))
    out["orders"].push_back({{"series", order.series},
                             {"integrator", kIntegratorNames[std::size_t(order.integrator)]},
                             {"step_rule", kStepRuleNames[std::size_t(order.stepRule)]},
                             {"observed_order", order.order},
                             {"points", order.points}});
  for (const auto& t : tables) {
    Json rowsOut = Json::array();
    for (std::size_t b = 0; b < t.cells.size(); ++b) {
      for (std::size_t s = 0; s < t.cells[b].size(); ++s) {
        const auto& cell = t.cells[b][s];
        rowsOut.push_back({{"budget", t.budgets[b]}, {"step", t.steps[s]}, {"time_ms", cell.time_ms}, {"rmse_255", cell.rmse_255}});
        if (cell.truth_rmse_255) rowsOut.back()["truth_rmse_255"] = *cell.truth_rmse_255;
        if (!cell.residency.empty()) rowsOut.back()["residency"] = cell.residency;
      }
    }
    out["tables"].push_back({{"title", t.title}, {"cells", rowsOut}});
  }
  if (!notes.empty()) out["notes"] = notes;
  out["total_s"] = total_s;
  return out.dump(1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace welkin::measure
