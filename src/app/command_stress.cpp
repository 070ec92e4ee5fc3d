#include <chrono>
#include <cmath>

#include "welkin/app/commands.h"
#include "welkin/app/stop.h"
#include "welkin/app/stress_map.h"
#include "welkin/core/files.h"
#include "welkin/core/progress.h"
#include "welkin/measure/stress.h"

namespace welkin::app {
namespace {

struct StressOptions {
  CommonOptions common;
  std::filesystem::path png;
  measure::StressSettings settings;
  std::optional<std::uint64_t> rays;
  bool orders = false;
};

void print(const measure::StressReport& report) {
  if (!report.cells.empty()) {
    fmt::print("{:<22} {:>7} {:>8} {:>10} {:>5} {:>5} {:>9} {:>13} {:>15}\n", "integrator", "cells", "failing", "predicted", "NaN", "Inf",
               "negative", "over furnace", "greatest error");
    for (const char* name : kIntegratorNames) {
      std::uint64_t cells = 0, failing = 0, predicted = 0, nan = 0, inf = 0, negative = 0, over = 0;
      double worst = 0;
      for (const auto& c : report.cells) {
        if (c.integrator != name) continue;
        cells++, failing += !c.ok(), predicted += c.predictedFail, nan += c.nan, inf += c.inf, negative += c.negative,
            over += c.overFurnace;
        worst = std::max(worst, c.relativeError.value_or(0));
      }
      fmt::print("{:<22} {:>7} {:>8} {:>10} {:>5} {:>5} {:>9} {:>13} {:>15.3g}\n", name, cells, failing, predicted, nan, inf, negative,
                 over, worst);
    }
    fmt::print("{} rays ({} in pictures), {:.1f} s; mispredicted {}, default ({}) failing {}\n", report.rays(), report.rays("pictures"),
               report.seconds, report.mispredicted(), report.defaultIntegrator, report.failingOfDefault());
    for (const auto& c : report.cells) {
      if (!c.ok() && !c.predictedFail)
        fmt::print("not predicted: {}, {} = {:g}, {}, {}: error {:.3g} (limit {:g}), {} NaN, {} Inf, {} negative, {} over{}{}\n", c.group,
                   c.axis, c.value, c.variant, c.integrator, c.relativeError.value_or(0), c.limit, c.nan, c.inf, c.negative, c.overFurnace,
                   c.note.empty() ? "" : "; ", c.note);
    }
  }
  fmt::print("{:<22} {:<22} {:>9} {:>9} {:>6}\n", "order of convergence", "integrator", "promised", "observed", "steps");
  for (const auto& o : report.orders) {
    fmt::print("{:<22} {:<22} {:>9} {:>9} {:>6}{}\n", o.line, kIntegratorNames[std::size_t(o.rule)], o.promised,
               o.observed.counts < 3 ? "exact" : fmt::format("{:.2f}", o.observed.slope), o.observed.counts, o.ok ? "" : "  FAILS");
  }
}

Result<void> runStress(StressOptions o) {
  beginCommand(o.common);
  for (const auto& file : {o.common.json, o.png}) {
    if (file.empty()) continue;
    if (auto writable = checkWritableFile(file); !writable) return writable;
  }
  listenForStop();
  const auto begin = std::chrono::steady_clock::now();
  measure::StressReport report;
  report.defaultIntegrator = kIntegratorNames[std::size_t(Quality{}.integrator)];
  report.orders = measure::checkOrders();
  if (!o.orders) {
    o.settings.rays = o.rays.value_or(o.settings.quick ? 100'000 : 1'200'000);
    auto context = gpu::Context::createHeadless(o.common.gpu);
    if (!context) return context.error();
    Progress progress("stress", o.common.quiet);
    auto pictures = measure::stressPictures(**context, o.settings, [&](double fraction) {
      progress.update(fraction);
      return !stopRequested();
    });
    if (!pictures) return pictures.error();
    progress.finish();
    for (const auto& cell : *pictures) o.settings.rays -= std::min(o.settings.rays, cell.rays);
    report.cells = measure::stressLines(o.settings);
    report.cells.insert(report.cells.end(), pictures->begin(), pictures->end());
  }
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!o.common.json.empty()) {
    if (auto written = writeFile(o.common.json, report.json() + "\n"); !written) return written;
  }
  if (!o.png.empty()) {
    if (auto written = writePng(o.png, stressMap(report), {}); !written) return written;
  }
  print(report);
  if (!report.ok()) return Error{"stress: the matrix does not hold"};
  return {};
}

}  // namespace

void addStress(CLI::App& app, Action& action) {
  auto o = std::make_shared<StressOptions>();
  auto* command = app.add_subcommand("stress", "the stability matrix: integrators and renderer where things are extreme");
  command->footer("Example:\n  welkin stress --json stress.json --png stress.png");
  command->add_flag("--quick", o->settings.quick, "fewer cells and rays");
  command->add_flag("--orders", o->orders, "orders of convergence only");
  command->add_option("--rays", o->rays, "rays at least (1200000; with --quick 100000)")->check(CLI::Range(1, 1000000000));
  command->add_option("--png", o->png, "draw the matrix")->check([](const std::string& text) {
    return kindOfName(text) == PictureKind::Png ? "" : "expected a name that ends in .png";
  });
  addGpuOption(*command, o->common);
  addOutputOptions(*command, o->common, "write every cell to this file");
  command->callback([o, &action] { action = [o] { return runStress(*o); }; });
}

}  // namespace welkin::app
