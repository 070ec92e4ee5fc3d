#include "written_files.h"

#include "welkin/app/picture.h"
#include "welkin/app/places.h"
#include "welkin/physics/scene_io.h"
#include "welkin/physics/scene_time.h"

namespace welkin::window {
namespace {

// Is this scene what its file says? Its exposure does not matter where the frames have their own.
bool asInItsFile(const Scene& scene, bool exposureMatters) {
  if (app::kindOfName(scene.file) != app::PictureKind::None) return false;
  auto file = loadScene(scene.file);
  if (!file) return false;
  Scene now = scene;
  now.views = file->views;
  if (!exposureMatters) now.output.exposure_ev = file->output.exposure_ev;
  return sceneToJson(now) == sceneToJson(*file);
}

}  // namespace

Result<std::filesystem::path> writeScene(const Model& model, const std::filesystem::path& folder) {
  Scene scene = atTime(model.scene, model.time_s);  // a scene begins at 0
  scene.views["default"] = model.view();
  auto stem = app::reserveFiles(folder, "welkin-scene", {".json"});
  if (!stem) return stem.error();
  const std::filesystem::path file = *stem += ".json";
  if (auto saved = saveScene(scene, file); !saved) return saved.error();
  return file;
}

Result<std::filesystem::path> writePath(Model& model, const std::filesystem::path& folder) {
  auto path = model.deck.tape.path();
  if (path.frames.empty()) return Error{"nothing is recorded"};
  const bool changed = !asInItsFile(model.scene, !path.frames.front().view.exposure_ev);
  auto file = app::saveRecorded(std::move(path), model.scene, changed, folder, "welkin-path");
  if (file) model.deck.saved(*file, sceneToJson(model.scene));
  return file;
}

void loadFlight(Model& model, FlightPath path) {
  const bool same = asInItsFile(model.scene, !path.frames.front().view.exposure_ev);
  const std::filesystem::path file = path.file;
  model.deck.load(std::move(path));
  model.deck.saved(same ? file : std::filesystem::path(), sceneToJson(model.scene));
  model.deck.play();
}

}  // namespace welkin::window
