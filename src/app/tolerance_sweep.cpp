#include "welkin/app/tolerance_sweep.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "welkin/app/draw.h"
#include "welkin/app/stop.h"
#include "welkin/core/files.h"
#include "welkin/core/progress.h"
#include "welkin/measure/tolerance.h"

namespace welkin::app {
namespace {

using Json = nlohmann::ordered_json;

struct Setting {
  double detailShare, step, spread;
  double rmse_255 = 0, time_ms = 0;
  FrameCounters met = {};
  std::vector<double> times = {};
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

class ViewSweep {
 public:
  ViewSweep(const ToleranceSweepOptions& options, Stage& stage, std::string name, View view)
      : options_(options),
        renderer_(*stage.renderer),
        software_(stage.context->device().software),
        name_(std::move(name)),
        view_(std::move(view)) {}

  Result<Json> run() {
    auto drawn = drawConverged(renderer_, view_, [](double) { return !stopRequested(); });
    if (!drawn) return drawn.error();
    exposure_ev_ = drawn->exposure_ev;
    if (auto measured = sweep(); !measured) return measured.error();
    Json out{{"view", name_},
             {"resident_detail", drawn->sampleDetail},
             {"pixel_detail", renderer_.shownDetail(view_)},
             {"bricks", drawn->residency.bricks},
             {"candidates", Json::array()},
             {"choices", Json::array()}};
    for (const Setting& s : settings_)
      out["candidates"].push_back({{"detail_share", s.detailShare}, {"step", s.step}, {"spread", s.spread}, {"rmse_255", s.rmse_255}, {"rays", s.met.marchedPixels}, {"cells", s.met.cells}, {"samples", s.met.samples}, {"time_ms", s.time_ms}});
    for (const double asked : options_.asked_255) {
      auto choice = choose(asked);
      if (!choice) return choice.error();
      out["choices"].push_back(std::move(*choice));
    }
    return out;
  }

 private:
  // Errors of all candidates; times of those that any tolerance could pick.
  Result<void> sweep() {
    const double greatest = 1.5 * *std::max_element(options_.asked_255.begin(), options_.asked_255.end());
    const auto truth = measure::drawTruth(renderer_, view_);
    if (!truth) return truth.error();
    for (const double share : measure::kDetailShares)
      for (const double step : measure::kSteps) {
        const std::size_t before = settings_.size();
        for (const double spread : measure::kSpreads) {
          Setting s{share, step, spread};
          const auto error = measure::reachedError(renderer_, view_, exposure_ev_, *truth, march(s));
          if (!error) return error.error();
          s.rmse_255 = *error;
          if (s.rmse_255 > greatest) break;  // more spread errs more
          settings_.push_back(std::move(s));
        }
        if (settings_.size() == before) break;  // so does a longer step
      }
    for (int turn = 0; turn < options_.repetitions; ++turn)
      for (Setting& s : settings_) {
        if (stopRequested()) return Error{"stopped before the sweep was whole"};
        if (auto used = renderer_.setMarch(march(s)); !used) return used;
        const PictureTime time = timePicture(renderer_, view_);
        s.times.push_back(software_ ? time.cpu_ms : time.wall_ms);
        s.met = time.counters;
      }
    for (Setting& s : settings_) s.time_ms = median(s.times);
    return {};
  }

  Quality march(const Setting& s) const { return measure::candidate(renderer_, view_, s.detailShare, s.step, s.spread); }

  Result<Json> choose(double asked_255) {
    Quality whole = renderer_.scene().quality;
    whole.detail = 0, whole.spread = 0;
    if (auto used = renderer_.setMarch(whole); !used) return used.error();
    const auto kept = measure::keepTolerance(renderer_, view_, exposure_ev_, asked_255);
    if (!kept) return kept.error();
    const Quality& q = kept->choice.quality;
    const double share = q.detail > 0 ? q.detail / renderer_.drawnDetail(view_) : 1;
    const Setting *picked = nullptr, *cheapest = nullptr;
    for (const Setting& s : settings_) {
      if (s.step == q.step && s.spread == q.spread && std::abs(s.detailShare - share) < 1e-6 * share) picked = &s;
      if (s.rmse_255 <= asked_255 && (!cheapest || s.time_ms < cheapest->time_ms)) cheapest = &s;
    }
    Json out{{"asked", asked_255},
             {"reached_rmse_255", kept->reached_255},
             {"estimate_rmse_255", kept->choice.estimate_255},
             {"step", q.step},
             {"spread", q.spread},
             {"detail_share", share},
             {"candidates_drawn", kept->choice.tried},
             {"rounds", kept->rounds + 1},
             {"kept", kept->reached_255 <= asked_255}};
    if (picked) out["time_ms"] = picked->time_ms;
    if (cheapest)
      out["cheapest"] = {{"step", cheapest->step},
                         {"spread", cheapest->spread},
                         {"detail_share", cheapest->detailShare},
                         {"time_ms", cheapest->time_ms},
                         {"rmse_255", cheapest->rmse_255}};
    return out;
  }

  const ToleranceSweepOptions& options_;
  Renderer& renderer_;
  bool software_;
  std::string name_;
  View view_;
  double exposure_ev_ = 0;
  std::vector<Setting> settings_;
};

void print(const Json& view) {
  for (const auto& c : view["choices"])
    fmt::print("{:16} asked {:4} reached {:6.3f}  detail {:.2f} step {:.2f} spread {:2.0f}  {:7.2f} ms, cheapest {:7.2f} ms\n",
               view["view"].get<std::string>(), c["asked"].get<double>(), c["reached_rmse_255"].get<double>(),
               c["detail_share"].get<double>(), c["step"].get<double>(), c["spread"].get<double>(), c.value("time_ms", 0.0),
               c.contains("cheapest") ? c["cheapest"]["time_ms"].get<double>() : 0.0);
}

}  // namespace

Result<std::vector<double>> parseTolerances(const std::string& text) {
  std::vector<double> out;
  for (std::size_t at = 0; at <= text.size();) {
    const auto comma = std::min(text.find(',', at), text.size());
    char* end = nullptr;
    const std::string one = text.substr(at, comma - at);
    const double value = std::strtod(one.c_str(), &end);
    if (one.empty() || *end != 0 || !(value >= 0.01 && value <= 255))
      return Error{fmt::format("expected errors from 0.01 to 255 such as 0.5,1,2, got {}", text)};
    out.push_back(value);
    at = comma + 1;
  }
  return out;
}

Result<void> toleranceSweep(const ToleranceSweepOptions& o) {
  auto start = loadStart(o.input, o.view);
  if (!start) return start.error();
  apply(o.common, start->scene);
  const Size size = o.common.size.value_or(Size{160, 90});
  std::vector<std::pair<std::string, View>> views;
  if (o.view.empty())
    for (const auto& [name, view] : start->scene.views) views.emplace_back(name, view);
  if (views.empty()) views.emplace_back(start->viewName, start->view);
  if (!o.common.json.empty())
    if (auto writable = checkWritableFile(o.common.json); !writable) return writable;
  listenForStop();
  RenderSettings settings;
  settings.width = size.width, settings.height = size.height;
  settings.reprojection = false;
  settings.time_s = start->time_s;
  auto stage = openStage(start->scene, settings, o.common.gpu);
  if (!stage) return stage.error();
  measure::ReportContext context = describeRun(start->scene, size);
  describeDevice(*stage->context, context);
  Json report{
      {"truth", {{"kind", "gpu"}, {"step", measure::truthMarch({}).step}, {"detail", "all that is resident, as fine as pixels show"}}},
      {"software", context.software},
      {"width", size.width},
      {"height", size.height},
      {"budget_bytes", start->scene.quality.budget_bytes},
      {"depth", start->scene.quality.depth},
      {"views", Json::array()}};
  Progress progress("tolerance", o.common.quiet);
  for (std::size_t i = 0; i < views.size(); ++i) {
    progress.update(double(i) / double(views.size()), views[i].first);
    Quality whole = start->scene.quality;
    whole.detail = 0, whole.spread = 0;
    if (auto used = stage->renderer->setMarch(whole); !used) return used;
    auto view = ViewSweep(o, *stage, views[i].first, views[i].second).run();
    if (!view) return Error{fmt::format("{}: {}", views[i].first, view.error().message)};
    print(*view);
    report["views"].push_back(std::move(*view));
  }
  progress.update(1);
  if (o.common.json.empty()) return {};
  return writeFile(o.common.json, report.dump(1) + "\n");
}

}  // namespace welkin::app
