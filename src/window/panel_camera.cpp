#include "panels.h"
#include "welkin/app/geographic.h"
#include "widgets.h"

namespace welkin::window {
namespace {

// Numbers that are typed in follow the camera until somebody edits them.
GeographicView g_there;
bool g_editing = false;

void place(Model& model, const GeographicView& here) {
  if (!g_editing) g_there = here;
  const auto field = [&](const char* label, double& value, const char* format, const char* text) {
    ImGui::InputDouble(label, &value, 0, 0, format);
    explain(text);
    g_editing = g_editing || ImGui::IsItemActive();
  };
  field("latitude", g_there.latitude_deg, "%.5f deg", "north positive, -90 to 90");
  field("longitude", g_there.longitude_deg, "%.5f deg", "east positive, -180 to 180");
  field("altitude", g_there.altitude_m, "%.1f m", "above the ground, from 1.5 m");
  if (press("Fly there", "a smooth flight to this place; heading and pitch stay")) {
    model.camera.goTo(std::clamp(g_there.latitude_deg, -90.0, 90.0), g_there.longitude_deg,
                      std::clamp(g_there.altitude_m, app::kEyeHeight_m, 1e10));
    g_editing = false;
  }
  ImGui::SameLine();
  if (press("Back to start", "Home does it too")) model.camera.flyTo(model.home), g_editing = false;
  if (g_editing) {
    ImGui::SameLine();
    if (ImGui::Button("Reset")) g_editing = false;
  }
}

// A button for each, as many in a row as there is room for. Which one was pressed with the right button?
std::string places(Model& model, const std::map<std::string, View>& views) {
  const float right = ImGui::GetWindowContentRegionMax().x;
  bool first = true;
  std::string right_pressed;
  for (const auto& [name, there] : views) {
    const float width = ImGui::CalcTextSize(name.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
    if (!first) {
      ImGui::SameLine();
      if (ImGui::GetCursorPosX() + width > right) ImGui::NewLine();
    }
    first = false;
    if (press(name.c_str(), nullptr)) {
      model.camera.flyTo(there);
      if (there.exposure_ev && model.exposure_ev) model.exposure_ev = there.exposure_ev;
    }
    if (ImGui::IsItemClicked(ImGuiMouseButton_Right)) right_pressed = name;
  }
  return right_pressed;
}

void bookmarks(Model& model) {
  auto& kept = model.settings.bookmarks;
  if (!kept.empty()) {
    ImGui::TextDisabled("bookmarks (right button: remove)");
    ImGui::PushID("bookmarks");
    if (const std::string gone = places(model, kept); !gone.empty()) kept.erase(gone), model.settingsChanged = true;
    ImGui::PopID();
  }
  if (!press("Bookmark this view", "kept in the settings, with its exposure")) return;
  const GeographicView here = app::toGeographic(model.camera.view(), model.scene.planet.radius_m);
  const std::string name = fmt::format("{}, {}", app::placeText(here), app::lengthText(here.altitude_m));
  kept[name] = model.view();
  model.settingsChanged = true;
}

}  // namespace

void cameraPanel(Model& model) {
  const GeographicView here = app::toGeographic(model.camera.view(), model.scene.planet.radius_m);
  place(model, here);
  line("heading", fmt::format("{:.1f}°, pitch {:.1f}°, roll {:.1f}°", here.heading_deg, here.pitch_deg, here.roll_deg));
  line("speed", app::lengthText(glm::length(model.camera.velocity_m_s())) + "/s");
  number("speed factor", model.camera.speedFactor, 1, {1 / app::kSpeedFactorRange, app::kSpeedFactorRange, "x %.3g", true},
         "of the speed, which grows with altitude; the wheel changes it too");
  View view = model.camera.view();
  if (number("field of view", view.fov_deg, model.home.fov_deg, {1, 120, "%.1f deg"}, "vertical").now) model.camera.setView(view);
  bookmarks(model);
  if (model.scene.views.empty()) return;
  ImGui::TextDisabled("views of the scene");
  places(model, model.scene.views);
}

}  // namespace welkin::window
