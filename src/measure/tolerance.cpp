#include "welkin/measure/tolerance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "welkin/measure/image_compare.h"

namespace welkin::measure {
namespace {

constexpr double kTruthStep = 0.01;    // a quarter of the finest candidate's
constexpr double kMargin = 0.93;       // of the tolerance is aimed at: chosen, for the pixels that are not tried; render measures them all
constexpr std::size_t kPixels = 6400;  // of a picture are tried
constexpr double kLookUpCost = 1.2;    // samples
constexpr double kRayCost = 8;         // samples
constexpr double kSpreadCost = 1.4;    // times: rays that run together are further apart, and stay less alike
constexpr int kMostRounds = 3;
constexpr int kMostDenied = 12;  // candidates that a prediction names and a picture denies
constexpr std::size_t kStepCount = std::size(kSteps);

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

constexpr std::size_t kSpreadCount = std::size(kSpreads);

// Indices into kDetailShares, kSteps, kSpreads.
struct Candidate {
  std::size_t detail, step, spread;
  auto operator<=>(const Candidate&) const = default;
  bool coarserThan(const Candidate& o) const { return detail >= o.detail && step >= o.step && spread >= o.spread; }
};
constexpr Candidate kFinest{0, 0, 0};

Quality marchOf(const Renderer& renderer, const View& view, const Candidate& c) {
  return candidate(renderer, view, kDetailShares[c.detail], kSteps[c.step], kSpreads[c.spread]);
}

struct Trial {
  double error_255, cost;
};

// Draws candidates, and says how far they are from the truth on some pixels.
class Trials {
 public:
  Trials(Renderer& renderer, const View& view, double exposure_ev) : renderer_(renderer), view_(view), exposure_ev_(exposure_ev) {}

  Result<void> begin() {
    renderer_.preview(view_);
    const ImageF whole = renderer_.radiance();
    all_ = std::size_t(whole.width) * std::size_t(whole.height);
    pixels_ = somePixels(whole.width, whole.height);
    if (auto drawn = draw(truthMarch(renderer_.scene().quality)); !drawn) return drawn.error();
    truth_ = picked();
    return {};
  }

  Result<Trial> operator()(const Candidate& c) {
    if (const auto found = done_.find(c); found != done_.end()) return found->second;
    auto cost = draw(marchOf(renderer_, view_, c));
    if (!cost) return cost.error();
    auto error = from(truth_);
    if (!error) return error.error();
    return done_[c] = {*error, *cost};
  }

  // What a spread adds, at a step of the middle: the picture with it against that without, and the share of its cost.
  Result<Trial> ofSpread(std::size_t spread) {
    const Candidate middle{0, kStepCount / 2, spread};
    auto cost = draw(marchOf(renderer_, view_, middle));
    if (!cost) return cost.error();
    if (spread == 0) unspread_ = picked(), unspreadCost_ = *cost;
    auto error = from(unspread_);
    if (!error) return error.error();
    return Trial{*error, *cost / std::max(unspreadCost_, 1e-9)};
  }

  // The cheapest of all that were drawn and keep it, if any does.
  std::optional<Candidate> cheapest(double error_255) const {
    std::optional<Candidate> best;
    for (const auto& [c, t] : done_)
      if (t.error_255 <= error_255 && (!best || t.cost < done_.at(*best).cost)) best = c;
    return best;
  }
  std::size_t pixels() const { return pixels_.size(); }
  int count() const { return int(done_.size()); }

 private:
  // Between its pixels a spread picture needs all others.
  Result<double> draw(const Quality& march) {
    if (auto used = renderer_.setMarch(march); !used) return used.error();
    if (march.spread > 0) return marchCost(march, renderer_.preview(view_), all_);
    auto counters = renderer_.preview(view_, pixels_);
    if (!counters) return counters.error();
    return marchCost(march, *counters, pixels_.size());
  }
  ImageF picked() const { return pick(renderer_.radiance(), pixels_); }
  Result<double> from(const ImageF& other) const {
    const auto error = compareShown(other, picked(), renderer_.scene().output.toneCurve, exposure_ev_);
    if (!error) return error.error();
    return error->rmse_255;
  }

  Renderer& renderer_;
  const View& view_;
  double exposure_ev_;
  std::size_t all_ = 0;
  std::vector<glm::ivec2> pixels_;
  ImageF truth_, unspread_;
  double unspreadCost_ = 0;
  std::map<Candidate, Trial> done_;
};

// One axis alone, until it errs too much by itself.
template <class Draw>
Result<std::vector<Trial>> alone(std::size_t count, double most_255, const Draw& draw) {
  std::vector<Trial> out;
  for (std::size_t i = 0; i < count; ++i) {
    const auto t = draw(i);
    if (!t) return t.error();
    out.push_back(*t);
    if (t->error_255 > most_255) break;
  }
  return out;
}

struct Predicted {
  Candidate candidate;
  double error_255, cost;
};

// Together: independent errors add in square, costs multiply. Cheapest first.
std::vector<Predicted> combinations(const std::vector<Trial>& details, const std::vector<Trial>& steps, const std::vector<Trial>& spreads) {
  std::vector<Predicted> out;
  for (std::size_t d = 0; d < details.size(); ++d)
    for (std::size_t s = 0; s < steps.size(); ++s)
      for (std::size_t p = 0; p < spreads.size(); ++p)
        out.push_back({{d, s, p},
                       std::hypot(details[d].error_255, steps[s].error_255, spreads[p].error_255),
                       details[d].cost * steps[s].cost / std::max(steps[0].cost, 1e-9) * spreads[p].cost});
  std::sort(out.begin(), out.end(), [](const Predicted& a, const Predicted& b) { return a.cost < b.cost; });
  return out;
}

}  // namespace

Quality truthMarch(const Quality& quality) {
  Quality truth = quality;
  truth.integrator = Integrator::ExponentialLinear, truth.stepRule = StepRule::Optical, truth.skipEmpty = true;
  truth.step = kTruthStep, truth.spread = 0;
  return truth;
}

Quality candidate(const Renderer& renderer, const View& view, double detailShare, double step, double spread) {
  Quality out = truthMarch(renderer.scene().quality);
  out.step = step, out.spread = spread;
  out.detail = detailShare < 1 ? detailShare * renderer.drawnDetail(view) : 0;
  return out;
}

double marchCost(const Quality& march, const FrameCounters& c, std::size_t pixels) {
  const double all = kLookUpCost * double(c.cells) + double(c.samples) + kRayCost * double(c.marchedPixels);
  return pixels ? all * (march.spread > 0 ? kSpreadCost : 1) / double(pixels) : 0;
}

Result<MarchChoice> chooseMarch(Renderer& renderer, const View& view, double exposure_ev, double tolerance_255, DrawnAs drawn) {
  const Quality before = renderer.scene().quality;
  MarchChoice choice;
  choice.quality = before;
  if (!renderer.plan().clouds) return choice;
  Quality whole = before;
  whole.detail = 0, whole.spread = 0;
  if (auto used = renderer.setMarch(whole); !used) return used.error();
  Trials trial(renderer, view, exposure_ev);
  if (auto begun = trial.begin(); !begun) return begun.error();
  const double wanted = kMargin * tolerance_255;
  const auto details = alone(std::size(kDetailShares), 1.5 * wanted, [&](std::size_t d) { return trial({d, 0, 0}); });
  if (!details) return details.error();
  const auto steps = alone(kStepCount, 1.5 * wanted, [&](std::size_t s) { return trial({0, s, 0}); });
  if (!steps) return steps.error();
  const auto spreads = alone(drawn == DrawnAs::Whole ? kSpreadCount : 1, 1.5 * wanted, [&](std::size_t p) { return trial.ofSpread(p); });
  if (!spreads) return spreads.error();
  // A picture has the last word. Errors also cancel: a little over is worth a look.
  std::vector<Candidate> denied;
  std::optional<Candidate> picked;
  for (const Predicted& p : combinations(*details, *steps, *spreads)) {
    if (picked || int(denied.size()) == kMostDenied) break;
    const auto worse = [&](const Candidate& d) { return p.candidate.coarserThan(d); };
    if (p.error_255 > 1.15 * wanted || std::any_of(denied.begin(), denied.end(), worse)) continue;
    const auto t = trial(p.candidate);
    if (!t) return t.error();
    if (t->error_255 <= wanted) picked = p.candidate;
    else denied.push_back(p.candidate);
  }
  if (!picked) picked = trial.cheapest(wanted);
  choice.kept = picked.has_value();
  const auto last = trial(picked.value_or(kFinest));
  if (!last) return last.error();
  choice.quality = marchOf(renderer, view, picked.value_or(kFinest));
  choice.estimate_255 = last->error_255, choice.cost = last->cost;
  choice.finest_255 = (*steps)[0].error_255;
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
    auto choice = chooseMarch(renderer, view, exposure_ev, aim, DrawnAs::Whole);
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
