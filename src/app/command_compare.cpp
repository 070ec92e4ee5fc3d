#include <cmath>
#include <nlohmann/json.hpp>

#include "welkin/app/commands.h"
#include "welkin/app/flight_result.h"
#include "welkin/core/files.h"
#include "welkin/measure/flip.h"
#include "welkin/measure/image_compare.h"

namespace welkin::app {
namespace {

struct CompareOptions {
  CommonOptions common;
  std::filesystem::path a, b, difference;
  std::optional<double> exposure_ev;
};

// Two results of flights: times by pass, and what was set differently.
Result<void> compareFlights(const CompareOptions& o) {
  if (!o.difference.empty()) return Error{fmt::format("{}: a picture of the difference is of two pictures", o.difference.string())};
  const auto a = loadFlightResult(o.a);
  if (!a) return a.error();
  const auto b = loadFlightResult(o.b);
  if (!b) return b.error();
  if (!o.common.json.empty()) {
    if (auto written = writeFile(o.common.json, comparisonJson(*a, *b)); !written) return written;
  }
  fmt::print("A: {}\nB: {}\n\n{}", o.a.string(), o.b.string(), comparisonText(compareResults(*a, *b)));
  return {};
}

Result<void> comparePictures(const CompareOptions& o) {
  auto a = readPicture(o.a);
  if (!a) return a.error();
  auto b = readPicture(o.b);
  if (!b) return b.error();
  if (a->pixels.index() != b->pixels.index()) {
    return Error{fmt::format("{}: expected a picture of the same kind (PNG or EXR) as {}", o.b.string(), o.a.string())};
  }
  const bool linear = std::holds_alternative<ImageF>(a->pixels);
  double exposure_ev = o.exposure_ev.value_or(0);
  if (linear && !o.exposure_ev) {  // as the first picture would be shown, if it says so
    if (auto state = stateFromTexts(a->texts, o.a)) exposure_ev = state->exposure_ev;
  }
  auto error = linear ? measure::compare(std::get<ImageF>(a->pixels), std::get<ImageF>(b->pixels), exposure_ev)
                      : measure::compare(std::get<Image8>(a->pixels), std::get<Image8>(b->pixels));
  if (!error) return Error{fmt::format("{}, {}: {}", o.a.string(), o.b.string(), error.error().message)};
  const auto shown = [&](const PictureFile& p) {
    return linear ? measure::toDisplay(std::get<ImageF>(p.pixels), exposure_ev) : std::get<Image8>(p.pixels);
  };
  auto flip = measure::flipDifference(shown(*a), shown(*b));
  if (!flip) return flip.error();
  error->flip = flip->mean;
  if (!o.difference.empty()) {
    if (auto writable = checkWritableFile(o.difference); !writable) return writable;
    if (auto written = writePng(o.difference, measure::flipPicture(*flip), {}); !written) return written;
  }
  if (!o.common.json.empty()) {
    nlohmann::ordered_json out{{"a", o.a.generic_string()},
                               {"b", o.b.generic_string()},
                               {"rmse_255", error->rmse_255},
                               {"mean_255", error->mean_255},
                               {"max_255", error->max_255},
                               {"p99_255", error->p99_255},
                               {"p999_255", error->p999_255},
                               {"share_over_1", error->shareOver1},
                               {"share_over_2", error->shareOver2},
                               {"share_over_16", error->shareOver16},
                               {"flip", error->flip},
                               {"not_finite", error->notFinite}};
    if (std::isfinite(error->psnr_db)) out["psnr_db"] = error->psnr_db;
    if (linear) out["linear_rmse"] = error->linearRmse, out["relative_rmse"] = error->relativeRmse, out["exposure_ev"] = exposure_ev;
    if (auto written = writeFile(o.common.json, out.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n"); !written)
      return written;
  }
  fmt::print("rmse     {:.4f}   (0-255)\n", error->rmse_255);
  fmt::print("psnr     {:.2f} dB\n", error->psnr_db);
  fmt::print("max      {:.3f}\np99      {:.3f}\n", error->max_255, error->p99_255);
  fmt::print("over 2   {:.4f} %  of the pixels\n", 100 * error->shareOver2);
  fmt::print("flip     {:.5f}\n", error->flip);
  if (linear)
    fmt::print("linear   rmse {:.6g}, relative {:.6g}, shown at {:+.2f} EV\n", error->linearRmse, error->relativeRmse, exposure_ev);
  if (error->notFinite > 0) fmt::print("not finite: {} pixels, left out\n", error->notFinite);
  return {};
}

Result<void> runCompare(const CompareOptions& o) {
  beginCommand(o.common);
  return isFlightResult(o.a) || isFlightResult(o.b) ? compareFlights(o) : comparePictures(o);
}

}  // namespace

void addCompare(CLI::App& app, Action& action) {
  auto o = std::make_shared<CompareOptions>();
  auto* command =
      app.add_subcommand("compare", "two pictures: RMSE, PSNR, max, perceived difference; or two results of fly: times by pass");
  command->footer(
      "Examples:\n  welkin compare before.png after.png -o difference.png\n  welkin compare before/timings.json after/timings.json");
  command->add_option("A", o->a, "a PNG or EXR picture, or a result (JSON) of welkin fly")->required();
  command->add_option("B", o->b, "another one of the same kind; pictures of the same size")->required();
  command->add_option("-o,--output", o->difference, "write the perceived difference as a PNG picture")->check([](const std::string& text) {
    return kindOfName(text) == PictureKind::Png ? "" : "expected a name that ends in .png";
  });
  command->add_option("--exposure", o->exposure_ev, "stops, for EXR pictures (default: as the first picture was shown)")
      ->check(CLI::Range(-40.0, 40.0));
  addOutputOptions(*command, o->common, "write the numbers to this file");
  command->callback([o, &action] { action = [o] { return runCompare(*o); }; });
}

}  // namespace welkin::app
