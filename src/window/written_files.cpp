#include "written_files.h"

#include "welkin/app/picture.h"
#include "welkin/app/places.h"
#include "welkin/physics/scene_io.h"

namespace welkin::window {
namespace {

constexpr double kPathStep_s = 1.0 / 30;

}  // namespace

Result<std::filesystem::path> writeScene(const Model& model, const std::filesystem::path& folder) {
  Scene scene = model.scene;
  scene.views["default"] = model.view();
  auto stem = app::reserveFiles(folder, "welkin-scene", {".json"});
  if (!stem) return stem.error();
  const std::filesystem::path file = *stem += ".json";
  if (auto saved = saveScene(scene, file); !saved) return saved.error();
  return file;
}

Result<std::filesystem::path> writePath(const Model& model, const std::filesystem::path& folder) {
  auto path = model.recording.path(kPathStep_s);
  if (!path) return path.error();
  path->name = model.scene.name;
  path->width = model.window.width, path->height = model.window.height;
  const bool changed = model.edits.canUndo() || app::kindOfName(model.scene.file) != app::PictureKind::None;
  return app::saveRecorded(std::move(*path), model.scene, changed, folder, "welkin-path");
}

}  // namespace welkin::window
