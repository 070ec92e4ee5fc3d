// The thesis' Table 6.1 (Pettersson 2020): time and error by budget and step.
#include <algorithm>
#include <array>
#include <cmath>

#include "converge_trees.h"
#include "welkin/app/stop.h"
#include "welkin/core/units.h"

namespace welkin::app {
namespace {

using measure::BudgetStepTable, measure::ConvergeRow, measure::ConvergeSetting;

// GTX 1080 Ti, 2560x1440: ms / RMSE on 0..255 against its own best picture; rows 8, 4, 2 GiB, columns step 0.1, 0.2 (its default), 0.4.
struct Published {
  double time_ms, rmse_255;
};
constexpr std::array<std::array<Published, 3>, 3> kPublished{
    {{{{19.4, 0}, {12.5, 0.52}, {9.9, 1.39}}}, {{{15.2, 0.72}, {8.9, 0.97}, {6.2, 1.76}}}, {{{12.8, 1.11}, {7.4, 1.37}, {4.9, 2.18}}}}};
constexpr std::array<double, 3> kSteps{0.1, 0.2, 0.4};
constexpr std::array<std::uint64_t, 3> kParts{1, 2, 4};
constexpr std::array<const char*, 3> kPartNames{"all of the tree", "half of it", "a quarter"};

constexpr std::uint64_t kFirstTry_bytes = 256ull << 20, kLastTry_bytes = 16ull << 30;
constexpr double kFull = 0.98;            // a pool fuller than this may have wanted more
constexpr double kGroupsPerBrick = 0.75;  // of the pools, as render/tree divides a budget
constexpr double kSlack = 1.02;           // pools are made of whole layers

bool ofThesis(const ConvergeSetting& s) { return s.quality.integrator == Integrator::Rectangle; }

std::string residencyText(const ConvergeRow& row) {
  const auto& r = row.residency;
  std::size_t deepest = 0;
  for (std::size_t i = 0; i < std::size(r.bricksByLevel); ++i) deepest = r.bricksByLevel[i] ? i : deepest;
  return fmt::format("{} bricks of {} ({:.0f} %), {} empty nodes, down to level {}, {} pending, {:.1f} nodes a radian", r.bricks,
                     r.brickCapacity, r.brickCapacity ? 100.0 * r.bricks / r.brickCapacity : 0.0, r.emptyNodes, deepest, r.pendingBricks,
                     row.residency.selectedDetail);
}

BudgetStepTable measured(const std::vector<ConvergeRow>& rows, bool thesis) {
  BudgetStepTable out;
  std::vector<double> steps;
  std::vector<std::uint64_t> budgets;
  for (const auto& row : rows) {
    if (ofThesis(row.setting) != thesis) continue;
    steps.push_back(row.setting.quality.step);
    budgets.push_back(row.setting.quality.budget_bytes);
  }
  std::sort(steps.begin(), steps.end());
  std::sort(budgets.rbegin(), budgets.rend());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  budgets.erase(std::unique(budgets.begin(), budgets.end()), budgets.end());
  for (const double step : steps) out.steps.push_back(fmt::format("step {:g}", step));
  for (const std::uint64_t budget : budgets) {
    out.budgets.push_back(fmt::format("{}, {}", bytesText(budget), kPartNames[std::min(out.budgets.size(), kPartNames.size() - 1)]));
    auto& cells = out.cells.emplace_back(steps.size());
    for (const auto& row : rows) {
      if (ofThesis(row.setting) != thesis || row.setting.quality.budget_bytes != budget) continue;
      const auto column = std::size_t(std::find(steps.begin(), steps.end(), row.setting.quality.step) - steps.begin());
      cells[column] = {row.time_ms.median, row.best_rmse_255.value_or(0), row.error.rmse_255, residencyText(row)};
    }
  }
  return out;
}

}  // namespace

// A tree that goes only as deep as pixels show, on ever larger budgets until it is not full: empty nodes have no bricks, so it ends.
Result<ThesisBudget> fillingBudget(const Poses& poses, Trees& trees, const ConvergeSetting& base) {
  ConvergeSetting setting = base;
  setting.quality.depth = kThesisDepth;
  for (std::uint64_t budget = kFirstTry_bytes; budget <= kLastTry_bytes; budget *= 4) {
    setting.quality.budget_bytes = budget;
    if (auto opened = trees.open(setting); !opened) return opened.error();
    const auto go = [](double) { return !stopRequested(); };
    if (auto settled = trees.settle(poses.views.front(), poses.times_s.front(), go); !settled) return settled.error();
    const auto r = trees.settled(setting).residency;
    trees.close();
    const double full =
        std::max(r.bricks / double(std::max(1u, r.brickCapacity)), r.groups / (kGroupsPerBrick * std::max(1u, r.brickCapacity)));
    if (full > kFull) continue;
    Scene scene = poses.scene;
    scene.quality = setting.quality;
    const auto rest = leastBudget(trees.context(), scene);
    if (!rest) return rest.error();
    return ThesisBudget{*rest, std::uint64_t(kSlack * full * double(budget - *rest))};
  }
  return Error{fmt::format("the view is not filled by {}", bytesText(kLastTry_bytes))};
}

std::vector<ConvergeSetting> thesisSettings(const ConvergeSetting& base, const ThesisBudget& budget) {
  ConvergeSetting thesis = base, ours = base;
  thesis.quality.depth = ours.quality.depth = kThesisDepth;
  thesis.quality.budget_bytes = ours.quality.budget_bytes = budget.of(1);
  thesis.quality.integrator = Integrator::Rectangle;
  thesis.quality.stepRule = StepRule::Node;
  thesis.quality.skipEmpty = false;
  SweepAxis budgets{"budget", {}}, steps{"step", {}};
  for (const std::uint64_t part : kParts) budgets.values.push_back(bytesExact(budget.of(part)));
  for (const double step : kSteps) steps.values.push_back(fmt::format("{:g}", step));
  std::vector<ConvergeSetting> out;
  merge(out, combine(thesis, {budgets, steps}));
  merge(out, combine(ours, {budgets, steps}));
  return out;
}

std::vector<BudgetStepTable> thesisTables(const std::vector<ConvergeRow>& rows) {
  BudgetStepTable published{"Published: GTX 1080 Ti, 2560x1440; RMSE against its own best picture", {}, {"8 GiB", "4 GiB", "2 GiB"}, {}};
  for (const double step : kSteps) published.steps.push_back(fmt::format("step {:g}", step));
  for (const auto& row : kPublished) {
    auto& cells = published.cells.emplace_back();
    for (const auto& p : row) cells.push_back({p.time_ms, p.rmse_255, std::nullopt, ""});
  }
  std::vector<BudgetStepTable> out{published, measured(rows, true), measured(rows, false)};
  out[1].title =
      "Here, its way: rectangles of the step times half the node, empty nodes marched; RMSE against its own best picture, in brackets "
      "against the truth";
  out[2].title =
      "Here, ours: the default integrator and step rule at the same factors; RMSE against its own best picture, in brackets against the "
      "truth";
  return out;
}

}  // namespace welkin::app
