#include <glad/gl.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <thread>

#include "commands.h"
#include "welkin/app/build_info.h"
#include "welkin/app/video.h"
#include "welkin/core/files.h"
#include "welkin/core/units.h"
#include "welkin/physics/scene_io.h"

namespace welkin::app {
namespace {

struct InfoOptions {
  CommonOptions common;
  std::filesystem::path scene;
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
  return {};
}

}  // namespace

void addInfo(CLI::App& app, Action& action) {
  auto o = std::make_shared<InfoOptions>();
  auto* command = app.add_subcommand("info", "version, OpenGL, limits, memory");
  command->footer("Example:\n  welkin info scenes/earth.json      with the least workable budget of a scene");
  command->add_option("SCENE", o->scene, "also print the least workable budget of this scene");
  addQualityOptions(*command, o->common);
  addOutputOptions(*command, o->common, "write the same to this file");
  command->callback([o, &action] { action = [o] { return runInfo(*o); }; });
}

}  // namespace welkin::app
