#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "welkin/measure/stress.h"

namespace welkin::measure {
namespace {

using Json = nlohmann::ordered_json;

// Four digits; what is not finite has no number in JSON.
Json number(double v) {
  if (!std::isfinite(v)) return nullptr;
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", v);
  return std::strtod(text, nullptr);
}

Json cellJson(const StressCell& c) {
  Json out{{"group", c.group},
           {"axis", c.axis},
           {"value", number(c.value)},
           {"case", c.variant},
           {"integrator", c.integrator},
           {"rays", c.rays},
           {"nan", c.nan},
           {"inf", c.inf},
           {"negative", c.negative},
           {"over_furnace", c.overFurnace}};
  out["relative_error"] = c.relativeError ? number(*c.relativeError) : Json(nullptr);
  out["limit"] = number(c.limit);
  out["depth_per_step"] = c.depthPerStep ? number(*c.depthPerStep) : Json(nullptr);
  out["predicted_error"] = number(c.predictedError);
  out["predicted_fail"] = c.predictedFail;
  out["ok"] = c.ok();
  if (!c.note.empty()) out["note"] = c.note;
  return out;
}

}  // namespace

bool StressCell::ok() const {
  return note.empty() && nan + inf + negative + overFurnace == 0 && (!relativeError || *relativeError <= limit);
}

std::uint64_t StressReport::rays(const std::string& group) const {
  std::uint64_t sum = 0;
  for (const auto& c : cells) sum += group.empty() || c.group == group ? c.rays : 0;
  return sum;
}
std::size_t StressReport::failing() const {
  return std::size_t(std::count_if(cells.begin(), cells.end(), [](const auto& c) { return !c.ok(); }));
}
std::size_t StressReport::mispredicted() const {
  return std::size_t(std::count_if(cells.begin(), cells.end(), [](const auto& c) { return !c.ok() && !c.predictedFail; }));
}
std::size_t StressReport::pessimistic() const {
  return std::size_t(std::count_if(cells.begin(), cells.end(), [](const auto& c) { return c.ok() && c.predictedFail; }));
}
std::size_t StressReport::failingOfDefault() const {
  return std::size_t(
      std::count_if(cells.begin(), cells.end(), [&](const auto& c) { return !c.ok() && c.integrator == defaultIntegrator; }));
}
bool StressReport::ok() const {
  for (const auto& c : cells)
    if (c.nan + c.inf + c.negative > 0) return false;
  return mispredicted() == 0 && failingOfDefault() == 0 && std::all_of(orders.begin(), orders.end(), [](const auto& o) { return o.ok; });
}

std::string StressReport::json() const {
  struct Sum {
    std::uint64_t cells = 0, failing = 0, predicted = 0, nan = 0, inf = 0, negative = 0, over = 0;
    double worst = 0;
  };
  std::map<std::string, Sum> sums;
  for (const auto& c : cells) {
    Sum& s = sums[c.integrator];
    s.cells++, s.failing += !c.ok(), s.predicted += c.predictedFail, s.nan += c.nan, s.inf += c.inf, s.negative += c.negative,
        s.over += c.overFurnace;
    s.worst = std::max(s.worst, c.relativeError.value_or(0));
  }
  Json integrators = Json::object();
  for (const char* name : kIntegratorNames) {
    const Sum& s = sums[name];
    integrators[name] = {{"cells", s.cells}, {"failing", s.failing},   {"predicted", s.predicted}, {"nan", s.nan},
                         {"inf", s.inf},     {"negative", s.negative}, {"over_furnace", s.over},   {"greatest_error", number(s.worst)}};
  }
  Json head{{"default_integrator", defaultIntegrator},
            {"rays", rays()},
            {"line_rays", rays("lines")},
            {"picture_rays", rays("pictures")},
            {"seconds", number(seconds)},
            {"failing", failing()},
            {"mispredicted", mispredicted()},
            {"pessimistic", pessimistic()},
            {"failing_of_default", failingOfDefault()},
            {"ok", ok()},
            {"integrators", integrators}};
  // One line a cell: a few thousand of them.
  std::string out = head.dump(1);
  out.resize(out.size() - 2);  // "\n}"
  const auto list = [&](const char* name, const auto& items, auto&& json) {
    out += std::string(",\n \"") + name + "\": [";
    for (std::size_t i = 0; i < items.size(); ++i)
      out += (i ? ",\n  " : "\n  ") + json(items[i]).dump(-1, ' ', false, Json::error_handler_t::replace);
    out += "\n ]";
  };
  list("orders", orders, [](const OrderCheck& o) {
    return Json{{"line", o.line},
                {"integrator", kIntegratorNames[std::size_t(o.rule)]},
                {"promised", o.promised},
                {"observed", number(o.observed.slope)},
                {"step_sizes", o.observed.counts},
                {"greatest_error", number(o.observed.greatestError)},
                {"greatest_error_per_step", number(o.observed.greatestPerStep)},
                {"ok", o.ok}};
  });
  list("cells", cells, cellJson);
  return out + "\n}";
}

}  // namespace welkin::measure
