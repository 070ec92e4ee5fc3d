#include "panels.h"

#include <imgui.h>

#include <algorithm>

#include "controls.h"
#include "welkin/app/geographic.h"
#include "welkin/gpu/timer.h"
#include "widgets.h"

namespace welkin::window {
namespace {

constexpr std::array<void (*)(Model&), kPanelNames.size()> kPanels{cameraPanel, scenePanel,    qualityPanel, exposurePanel,
                                                                   timePanel,   profilerPanel, memoryPanel,  leftOutPanel,
                                                                   logPanel,    debugPanel,    flightPanel,  resultsPanel};
constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

float statusHeight() { return ImGui::GetTextLineHeight() + 10; }

void sidebar(Model& model) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float width = std::min(ImGui::GetFontSize() * 25, screen.x);
  ImGui::SetNextWindowPos({screen.x - width, 0});
  ImGui::SetNextWindowSize({width, std::max(screen.y - statusHeight(), 1.0f)});
  if (ImGui::Begin("panels", nullptr, kFixed & ~ImGuiWindowFlags_NoScrollbar)) {
    ImGui::PushItemWidth(-ImGui::GetFontSize() * 9);
    for (std::size_t i = 0; i < kPanels.size(); ++i) {
      ImGui::SetNextItemOpen(model.open[i]);
      const std::string title = fmt::format("{}  {}", kPanelKeys[i], kPanelNames[i]);
      model.open[i] = ImGui::CollapsingHeader(title.c_str());
      if (model.showNow == Panel(i)) ImGui::SetScrollHereY(0), model.showNow.reset();
      if (!model.open[i]) continue;
      ImGui::PushID(int(i));
      kPanels[i](model);
      ImGui::Spacing();
      ImGui::PopID();
    }
    ImGui::PopItemWidth();
  }
  ImGui::End();
}

void status(const Model& model) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, screen.y - statusHeight()});
  ImGui::SetNextWindowSize({screen.x, statusHeight()});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10, 5});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  if (ImGui::Begin("status", nullptr, kFixed | ImGuiWindowFlags_NoInputs)) {
    const GeographicView at = app::toGeographic(model.camera.view(), model.scene.planet.radius_m);
    std::string line = fmt::format("{}   {}   {}/s", app::placeText(at), app::lengthText(at.altitude_m),
                                   app::lengthText(glm::length(model.camera.velocity_m_s())));
    line += fmt::format("   |   {:.0f} frames/s   {} x {}", model.frameRate, model.picture.width, model.picture.height);
    if (model.scale.scale() < 1)
      line += fmt::format(", {:.0f} % of the window{}", 100 * model.scale.scale(), model.scale.automatic ? " to keep 20 frames/s" : "");
    if (model.flight)
      line += fmt::format("   |   {} {:.0f} %", kFlightTasks[std::size_t(model.flight->task)], 100 * model.flight->progress.fraction);
    else if (model.deck.mode() == Deck::Mode::Recording)
      line += fmt::format("   |   recording, {:.0f} s", model.deck.at_s());
    else if (model.loading_s >= 0)
      line += fmt::format("   |   preparing the scene, {:.1f} s", model.loading_s);
    else if (model.stats.skyProgress < 1)
      line += fmt::format("   |   light of the air {:.0f} %", 100 * model.stats.skyProgress);
    else if (model.stats.residency.pendingBricks > 0)
      line += fmt::format("   |   {} bricks to come", model.stats.residency.pendingBricks);
    ImGui::TextUnformatted(line.c_str());
    const char* hint = "H: keys   Tab: panels";
    ImGui::SameLine(screen.x - ImGui::CalcTextSize(hint).x - 10);
    if (ImGui::GetCursorPosX() > ImGui::CalcTextSize(line.c_str()).x + 20) ImGui::TextDisabled("%s", hint);
  }
  ImGui::End();
  ImGui::PopStyleVar(3);
}

void message(const Model& model) {
  const bool first = !model.painted;  // nothing to see yet
  if (!first && gpu::wall_ms() / 1000 > model.messageUntil_s) return;
  const std::string text = first && (model.message.empty() || !model.messageBad) ? "preparing " + model.scene.name + " ..." : model.message;
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float room = screen.x - (model.sidebar ? ImGui::GetFontSize() * 25 : 0);
  ImGui::SetNextWindowPos({room / 2, screen.y - statusHeight() - 12}, 0, {0.5f, 1});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {std::max(room - 40, 100.0f), screen.y});
  if (ImGui::Begin("message", nullptr, kFixed | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_AlwaysAutoResize)) {
    ImGui::PushTextWrapPos(std::max(room - 80, 80.0f));
    if (model.messageBad)
      ImGui::TextColored({1, 0.72f, 0.45f, 1}, "%s", text.c_str());
    else
      ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
}

// Over the picture if there is room, else over the panels; in a small window with smaller letters.
void help(const Model& model) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  const float bar = model.sidebar ? ImGui::GetFontSize() * 25 : 0;
  const float room = screen.x - bar > ImGui::GetFontSize() * 30 ? screen.x - bar : screen.x;
  const float needed = float(kKeyLines.size()) * (ImGui::GetTextLineHeightWithSpacing() + 2) + 20;
  ImGui::SetNextWindowPos({room / 2, (screen.y - statusHeight()) / 2}, 0, {0.5f, 0.5f});
  ImGui::SetNextWindowFocus();
  ImGui::SetNextWindowBgAlpha(0.96f);  // over fields
  if (ImGui::Begin("keys", nullptr, kFixed | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs)) {
    ImGui::SetWindowFontScale(std::clamp((screen.y - statusHeight()) / needed, 0.6f, 1.0f));
    if (ImGui::BeginTable("lines", 2, ImGuiTableFlags_SizingFixedFit)) {
      for (const KeyLine& line : kKeyLines) {
        ImGui::TableNextColumn();
        ImGui::TextColored({0.95f, 0.78f, 0.5f, 1}, "%s", line.keys);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(line.what);
      }
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

}  // namespace

void drawInterface(Model& model) {
  beginFields();
  if (model.sidebar) sidebar(model);
  status(model);
  message(model);
  if (model.help) help(model);
}

}  // namespace welkin::window
