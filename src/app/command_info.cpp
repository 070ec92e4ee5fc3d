#include <glad/gl.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "welkin/app/commands.h"
#include "welkin/app/build_info.h"
#include "welkin/app/video.h"
#include "welkin/core/files.h"
#include "welkin/core/units.h"
#include "welkin/gpu/timer.h"
#include "welkin/physics/air.h"
#include "welkin/physics/scene_io.h"
#include "welkin/render/sky/sky_field.h"
#include "welkin/render/sky/sky_tables.h"

namespace welkin::app {
namespace {

struct InfoOptions {
  CommonOptions common;
  std::filesystem::path scene;
  bool tables = false;
};

struct Limit {
  const char* name;
  GLenum key;
};
constexpr Limit kLimits[] = {{"max_texture_size", GL_MAX_TEXTURE_SIZE},
                             {"max_3d_texture_size", GL_MAX_3D_TEXTURE_SIZE},
                             {"max_array_texture_layers", GL_MAX_ARRAY_TEXTURE_LAYERS},
                             {"max_shader_storage_block_size", GL_MAX_SHADER_STORAGE_BLOCK_SIZE},
                             {"max_uniform_block_size", GL_MAX_UNIFORM_BLOCK_SIZE},
                             {"max_compute_shared_memory_size", GL_MAX_COMPUTE_SHARED_MEMORY_SIZE},
                             {"max_compute_work_group_invocations", GL_MAX_COMPUTE_WORK_GROUP_INVOCATIONS},
                             {"max_compute_texture_image_units", GL_MAX_COMPUTE_TEXTURE_IMAGE_UNITS}};

// A planet with the Earth's air.
Scene clearEarth() {
  Scene scene;
  scene.planet = {6'360'000, {0.3, 0.3, 0.3}, {}};
  scene.atmosphere = earthAir();
  scene.sun = Sun{};
  return scene;
}

// Each model's tables made twice: the first turn warms the driver's cache of shaders. Fields on disk are not used.
Result<nlohmann::ordered_json> measureTables(Scene scene) {
  if (!scene.atmosphere) return Error{"--tables: the scene has no atmosphere"};
  ::setenv("WELKIN_CACHE", "", 1);
  auto out = nlohmann::ordered_json::array();
  for (const char* model : {"tables-4d", "tables-2d", "march"}) {
    scene.atmosphere->model = model;
    double wall_s[2], cpu_s = 0;
    nlohmann::ordered_json row;
    for (double& wall : wall_s) {
      gpu::MemoryAccount account(scene.quality.budget_bytes);
      glFinish();
      const double wall0 = gpu::wall_ms(), cpu0 = gpu::processCpu_ms();
      auto tables = SkyTables::create(account, scene);
      if (!tables) return tables.error();
      glFinish();
      wall = (gpu::wall_ms() - wall0) / 1000, cpu_s = (gpu::processCpu_ms() - cpu0) / 1000;
      row = {{"model", model}, {"wall_s", wall}, {"cpu_s", cpu_s}, {"first_wall_s", wall_s[0]}, {"bytes", tables->bytes()},
             {"orders", tables->field().orders()}, {"rest", tables->field().rest()}};
    }
    out.push_back(row);
  }
  return out;
}

Result<void> runInfo(const InfoOptions& o) {
  beginCommand(o.common);
  nlohmann::ordered_json out{
      {"version", version()}, {"build", buildText()}, {"cpu", cpuName()}, {"cpus", std::thread::hardware_concurrency()}};
  const auto page = ::sysconf(_SC_PAGESIZE), pages = ::sysconf(_SC_PHYS_PAGES);
  out["memory_bytes"] = std::uint64_t(page > 0 && pages > 0 ? page : 0) * std::uint64_t(pages > 0 ? pages : 0);
  out["ffmpeg"] = haveFfmpeg();
  std::optional<Scene> scene;
  if (!o.scene.empty()) {
    auto loaded = loadScene(o.scene);
    if (!loaded) return loaded.error();
    scene = std::move(*loaded);
    apply(o.common, *scene);
  }
  auto context = gpu::Context::createHeadless(o.common.gpu);
  if (!context) return context.error();
  const auto& device = (*context)->device();
  out["gl"] = {{"renderer", device.renderer}, {"version", device.version}, {"vendor", device.vendor}, {"software", device.software}};
  for (const auto& limit : kLimits) {
    GLint64 value = 0;
    glGetInteger64v(limit.key, &value);
    out["gl"]["limits"][limit.name] = value;
  }
  if (scene) {
    const auto least = leastBudget(**context, *scene);
    if (!least) return least.error();
    out["scene"] = {{"file", o.scene.generic_string()}, {"budget_bytes", scene->quality.budget_bytes}, {"least_budget_bytes", *least}};
  }
  if (o.tables) {
    auto measured = measureTables(scene.value_or(clearEarth()));
    if (!measured) return measured.error();
    out["tables"] = *measured;
  }
  if (!o.common.json.empty()) {
    if (auto written = writeFile(o.common.json, out.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n"); !written)
      return written;
  }
  fmt::print("{}\n", buildText());
  fmt::print("CPU      {}, {} threads, {}\n", cpuName(), std::thread::hardware_concurrency(),
             bytesText(out["memory_bytes"].get<std::uint64_t>()));
  fmt::print("OpenGL   {}, {}, {}{}\n", device.version, device.renderer, device.vendor,
             device.software ? " (software: no GPU is used)" : "");
  for (const auto& limit : kLimits) fmt::print("         {} {}\n", limit.name, out["gl"]["limits"][limit.name].get<std::int64_t>());
  fmt::print("ffmpeg   {}\n", haveFfmpeg() ? "found" : "not found: no videos");
  if (scene) {
    fmt::print("scene    {}: budget {}, least workable {}\n", o.scene.string(),
               bytesText(out["scene"]["budget_bytes"].get<std::uint64_t>()),
               bytesText(out["scene"]["least_budget_bytes"].get<std::uint64_t>()));
  }
  if (o.tables) {
    fmt::print("tables   model       time s   CPU s   first   bytes  orders  missing\n");
    for (const auto& row : out["tables"])
      fmt::print("         {:<10} {:7.3f} {:7.3f} {:7.3f} {:>8} {:6} {:8.1e}\n", row["model"].get<std::string>(), row["wall_s"].get<double>(),
                 row["cpu_s"].get<double>(), row["first_wall_s"].get<double>(), bytesText(row["bytes"].get<std::uint64_t>()),
                 row["orders"].get<int>(), row["rest"].get<double>());
  }
  return {};
}

}  // namespace

void addInfo(CLI::App& app, Action& action) {
  auto o = std::make_shared<InfoOptions>();
  auto* command = app.add_subcommand("info", "version, OpenGL, limits, memory");
  command->footer("Example:\n  welkin info scenes/earth.json      with the least workable budget of a scene");
  command->add_option("SCENE", o->scene, "also print the least workable budget of this scene");
  command->add_flag("--tables", o->tables, "make the sky's tables by each model: time and size (of the SCENE, or of the Earth's air)");
  addQualityOptions(*command, o->common);
  addOutputOptions(*command, o->common, "write the same to this file");
  command->callback([o, &action] { action = [o] { return runInfo(*o); }; });
}

}  // namespace welkin::app
