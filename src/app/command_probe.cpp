#include "welkin/app/commands.h"
#include "probe_clouds.h"
#include "welkin/app/probe_csv.h"
#include "welkin/core/files.h"
#include "welkin/core/progress.h"
#include "welkin/gpu/context.h"
#include "welkin/physics/scene_io.h"
#include "welkin/reference/parallel.h"
#include "welkin/reference/radiance.h"
#include "welkin/reference/random.h"
#include "welkin/render/sky/sky_probe.h"

namespace welkin::app {
namespace {

struct ProbeOptions {
  CommonOptions common;
  std::filesystem::path scene, rays, out;
  std::string method = "reference";
  reference::PathSettings paths{.threads = 0};
};

struct Probed {
  std::vector<ProbeResult> results;  // one a ray
  bool withErrors = false;           // results carry standard errors
};

Result<Probed> probeReference(const Scene& scene, const std::vector<ProbeRay>& rays, const ProbeOptions& o) {
  if (scene.clouds) {
    auto results = probeCloudsReference(scene, rays, o.paths, o.common.quiet);
    if (!results) return Error{fmt::format("{}: {}", o.scene.string(), results.error().message)};
    return Probed{std::move(*results), true};
  }
  auto medium = reference::makeMedium(scene);
  if (!medium) return Error{fmt::format("{}: {}", o.scene.string(), medium.error().message)};
  Probed out;
  out.results.resize(rays.size());
  Progress progress("probe", o.common.quiet);
  const auto done = [&](std::size_t n) { progress.update(double(n) / double(rays.size())); };
  if (o.paths.maxOrders == 1) {
    reference::forEach(
        rays.size(), o.paths.threads, [&](std::size_t i) { out.results[i] = reference::singleOrderRadiance(*medium, rays[i]); }, done);
    return out;
  }
  out.withErrors = true;
  const reference::PathTracer tracer(*medium);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    reference::PathSettings paths = o.paths;
    paths.seed = reference::mixSeeds(o.paths.seed, i);
    out.results[i] = reference::radiance(*medium, tracer, rays[i], paths);
    done(i + 1);
  }
  return out;
}

Result<Probed> probeTables(Scene scene, const std::vector<ProbeRay>& rays, const ProbeOptions& o) {
  if (o.paths.maxOrders > 1) return Error{"methods other than reference know --orders 1 and all orders"};
  if (!scene.atmosphere && !scene.clouds) return Error{fmt::format("{}: the scene has neither air nor clouds", o.scene.string())};
  if (scene.atmosphere) scene.atmosphere->model = o.method;
  if (scene.clouds) {
    if (o.paths.maxOrders == 1) return Error{fmt::format("{}: the scene has clouds, whose light is not told apart by orders", o.scene.string())};
    auto results = probeClouds(scene, rays, o.common);
    if (!results) return Error{fmt::format("{}: {}", o.scene.string(), results.error().message)};
    return Probed{std::move(*results), false};
  }
  auto context = gpu::Context::createHeadless(o.common.gpu);
  if (!context) return context.error();
  scene.sun = scene.sun.value_or(Sun{});
  gpu::MemoryAccount account(scene.quality.budget_bytes);
  auto tables = SkyTables::create(account, scene, o.paths.maxOrders == 1 ? SkyOrders::First : SkyOrders::All);
  if (!tables) return Error{fmt::format("{}: {}", o.scene.string(), tables.error().message)};
  auto results = probeSky(account, *tables, scene, rays);
  if (!results) return results.error();
  return Probed{std::move(*results), false};
}

Result<void> runProbe(const ProbeOptions& o) {
  beginCommand(o.common);
  if (!o.out.empty()) {
    if (auto writable = checkWritableFile(o.out); !writable) return writable;
  }
  auto scene = loadScene(o.scene);
  if (!scene) return scene.error();
  auto table = readProbeTable(o.rays);
  if (!table) return table.error();
  auto probed = o.method == "reference" ? probeReference(*scene, table->rays, o) : probeTables(*scene, table->rays, o);
  if (!probed) return probed.error();
  const std::string text = probeResultText(*table, probed->results, probed->withErrors);
  if (!o.out.empty()) return writeFile(o.out, text);
  fmt::print("{}", text);
  return {};
}

}  // namespace

void addProbe(CLI::App& app, Action& action) {
  auto o = std::make_shared<ProbeOptions>();
  auto* command = app.add_subcommand("probe", "radiance and transmittance along rays, for a solar irradiance of 1");
  command->footer(
      "Rays are rows of a CSV: altitude_m,sun_zenith_deg,view_zenith_deg,relative_azimuth_deg[,max_distance_m]\n"
      "[,latitude_deg,longitude_deg], in any order. Clouds of the scene are on the ray;\n"
      "the reference follows paths through them, which takes long: give it a --relative-error such as 0.02.\n"
      "Example:\n  welkin probe scenes/earth.json --rays rays.csv -o sky.csv --method reference --orders 1");
  command->add_option("SCENE", o->scene, "a scene (JSON)")->required();
  command->add_option("--rays", o->rays, "the rays, CSV")->required();
  command->add_option("-o,--output", o->out, "write here; else to stdout");
  command->add_option("--method", o->method, "reference, tables-4d, tables-2d or march")
      ->check(CLI::IsMember({"reference", "tables-4d", "tables-2d", "march"}));
  command->add_option("--orders", o->paths.maxOrders, "times that light may meet air or ground at most; 1: single scattering. Default: any")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--relative-error", o->paths.relativeError, "standard error over radiance at which the reference stops (0.003)")
      ->check(CLI::Range(1e-6, 1.0));
  command->add_option("--max-paths", o->paths.maxPaths, "paths of a ray at most (4000000)")->check(CLI::Range(1, 2000000000));
  command->add_option("--seed", o->paths.seed, "seed of the reference: another one is an independent estimate");
  command->add_option("--threads", o->paths.threads, "threads of the reference; default: one a core")->check(CLI::Range(1, 1024));
  addGpuOption(*command, o->common);
  command->add_flag("--quiet,-q", o->common.quiet, "no log lines and no progress bar, only warnings and errors");
  command->callback([o, &action] { action = [o] { return runProbe(*o); }; });
}

}  // namespace welkin::app
