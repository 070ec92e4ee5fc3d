#include "welkin/measure/tolerance.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "welkin/measure/image_compare.h"

namespace welkin::measure {
namespace {

constexpr double kTruthStep = 0.01;    // a quarter of the finest candidate's
constexpr double kMargin = 0.93;       // of the tolerance is aimed at: chosen, for the pixels that are not tried; render measures them all
constexpr std::size_t kPixels = 6400;  // of a picture are tried
constexpr double kLookUpCost = 2.6;    // samples
constexpr int kMostRounds = 3;
constexpr int kMostChecks = 8;  // candidates that a prediction names and a picture denies

constexpr std::size_t kDetails = std::size(kDetailShares), kStepCount = std::size(kSteps);
constexpr std::size_t kFineStep = 0;  // errors of detail alone are measured at this step, those of the step alone at full detail

// One pixel of each block of n x n, anywhere in it: a regular pattern could fall in with the picture's own.
std::vector<glm::ivec2> somePixels(int width, int height) {
  const int n = std::max(1, int(std::sqrt(double(width) * height / kPixels)));
  std::vector<glm::ivec2> out;
  std::uint32_t state = 1;
  for (int y = 0; y < height; y += n)
    for (int x = 0; x < width; x += n) {
      state = state * 1664525u + 1013904223u;  // Numerical Recipes' quick generator
      const glm::ivec2 p{x + int((state >> 16) % unsigned(n)), y + int((state >> 24) % unsigned(n))};
      if (p.x < width && p.y < height) out.push_back(p);
    }
  return out;
}

ImageF pick(const ImageF& picture, const std::vector<glm::ivec2>& pixels) {
  ImageF out{int(pixels.size()), 1, {}};
  out.rgba.reserve(pixels.size() * 4);
  for (const glm::ivec2 p : pixels) {
    const auto from = picture.rgba.begin() + std::ptrdiff_t(4 * (std::size_t(p.y) * std::size_t(picture.width) + std::size_t(p.x)));
    out.rgba.insert(out.rgba.end(), from, from + 4);
  }
  return out;
}

struct Trial {
  double error_255, cost;
};

class Trials {
 public:
  Trials(Renderer& renderer, const View& view, double exposure_ev) : renderer_(renderer), view_(view), exposure_ev_(exposure_ev) {}

  Result<void> begin() {
    renderer_.preview(view_);
    const ImageF whole = renderer_.radiance();
    pixels_ = somePixels(whole.width, whole.height);
    if (auto drawn = draw(truthMarch(renderer_.scene().quality)); !drawn) return drawn.error();
    truth_ = pick(renderer_.radiance(), pixels_);
    return {};
  }

  Result<Trial> operator()(std::size_t detail, std::size_t step) {
    const auto key = detail * kStepCount + step;
    if (const auto found = done_.find(key); found != done_.end()) return found->second;
    auto counters = draw(candidate(renderer_, view_, kDetailShares[detail], kSteps[step]));
    if (!counters) return counters.error();
    const auto error = compareShown(truth_, pick(renderer_.radiance(), pixels_), renderer_.scene().output.toneCurve, exposure_ev_);
    if (!error) return error.error();
    return done_[key] = {error->rmse_255, rayCost(*counters)};
  }
  std::size_t pixels() const { return pixels_.size(); }
  int count() const { return int(done_.size()); }

 private:
  Result<FrameCounters> draw(const Quality& march) {
    if (auto used = renderer_.setMarch(march); !used) return used.error();
    return renderer_.preview(view_, pixels_);
  }
  Renderer& renderer_;
  const View& view_;
  double exposure_ev_;
  std::vector<glm::ivec2> pixels_;
  ImageF truth_;
  std::map<std::size_t, Trial> done_;
};

struct Candidate {
  std::size_t detail, step;
  double error_255, cost;
};

}  // namespace

Quality truthMarch(const Quality& quality) {
  Quality truth = quality;
  truth.integrator = Integrator::ExponentialLinear, truth.stepRule = StepRule::Optical, truth.skipEmpty = true;
  truth.step = kTruthStep;
  return truth;
}

Quality candidate(const Renderer& renderer, const View& view, double detailShare, double step) {
  Quality out = truthMarch(renderer.scene().quality);
  out.step = step;
  out.detail = detailShare < 1 ? detailShare * renderer.drawnDetail(view) : 0;
  return out;
}

double rayCost(const FrameCounters& c) {
  return c.marchedPixels ? (kLookUpCost * double(c.cells) + double(c.samples)) / double(c.marchedPixels) : 0;
}

Result<MarchChoice> chooseMarch(Renderer& renderer, const View& view, double exposure_ev, double tolerance_255) {
  const Quality before = renderer.scene().quality;
  MarchChoice choice;
  choice.quality = before;
  if (!renderer.plan().clouds) return choice;
  Quality whole = before;
  whole.detail = 0;
  if (auto used = renderer.setMarch(whole); !used) return used.error();
  Trials trial(renderer, view, exposure_ev);
  if (auto begun = trial.begin(); !begun) return begun.error();
  const double wanted = kMargin * tolerance_255;
  // Errors of detail and of step alone; both stop where they are too great by themselves.
  std::vector<Trial> byDetail, byStep;
  for (std::size_t d = 0; d < kDetails; ++d) {
    const auto t = trial(d, kFineStep);
    if (!t) return t.error();
    byDetail.push_back(*t);
    if (t->error_255 > 1.5 * wanted) break;
  }
  for (std::size_t s = 0; s < kStepCount; ++s) {
    const auto t = trial(0, s);
    if (!t) return t.error();
    byStep.push_back(*t);
    if (t->error_255 > 1.5 * wanted) break;
  }
  // Together: independent errors add in square, samples multiply. Cheapest first; a picture has the last word.
  std::vector<Candidate> candidates;
  for (std::size_t d = 0; d < byDetail.size(); ++d)
    for (std::size_t s = 0; s < byStep.size(); ++s)
      candidates.push_back({d, s, std::hypot(byDetail[d].error_255, byStep[s].error_255),
                            byDetail[d].cost * byStep[s].cost / std::max(byStep[kFineStep].cost, 1e-9)});
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  std::size_t detail = 0, step = kFineStep;
  int checks = 0;
  choice.kept = false;
  for (const Candidate& c : candidates) {
    if (c.error_255 > 1.15 * wanted || checks == kMostChecks) continue;  // errors also cancel: a little over is worth a look
    const auto t = trial(c.detail, c.step);
    if (!t) return t.error();
    ++checks;
    if (t->error_255 > wanted) continue;
    detail = c.detail, step = c.step;
    choice.kept = true;
    break;
  }
  const auto last = trial(detail, step);
  if (!last) return last.error();
  if (!choice.kept) choice.kept = last->error_255 <= wanted;
  choice.quality = candidate(renderer, view, kDetailShares[detail], kSteps[step]);
  choice.estimate_255 = last->error_255, choice.cost = last->cost;
  choice.finest_255 = byStep[kFineStep].error_255;
  choice.tried = trial.count(), choice.pixels = trial.pixels();
  if (auto used = renderer.setMarch(choice.quality); !used) return used.error();
  return choice;
}

Result<ImageF> drawMarch(Renderer& renderer, const View& view, const Quality& march) {
  if (auto used = renderer.setMarch(march); !used) return used.error();
  renderer.preview(view);
  return renderer.radiance();
}

Result<ImageF> drawTruth(Renderer& renderer, const View& view) {
  Quality truth = truthMarch(renderer.scene().quality);
  truth.detail = 0;
  return drawMarch(renderer, view, truth);
}

Result<double> reachedError(Renderer& renderer, const View& view, double exposure_ev, const ImageF& truth, const Quality& march) {
  const auto drawn = drawMarch(renderer, view, march);
  if (!drawn) return drawn.error();
  const auto error = compareShown(truth, *drawn, renderer.scene().output.toneCurve, exposure_ev);
  if (!error) return error.error();
  return error->rmse_255;
}

Result<KeptTolerance> keepTolerance(Renderer& renderer, const View& view, double exposure_ev, double tolerance_255) {
  KeptTolerance kept;
  const auto truth = drawTruth(renderer, view);
  if (!truth) return truth.error();
  for (double aim = tolerance_255; kept.rounds < kMostRounds; ++kept.rounds) {
    auto choice = chooseMarch(renderer, view, exposure_ev, aim);
    if (!choice) return choice.error();
    kept.choice = *choice;
    const auto reached = reachedError(renderer, view, exposure_ev, *truth, choice->quality);
    if (!reached) return reached.error();
    kept.reached_255 = *reached;
    if (*reached <= tolerance_255 || !choice->kept) break;
    aim *= std::min(tolerance_255 / *reached, 0.95);
  }
  return kept;
}

}  // namespace welkin::measure
