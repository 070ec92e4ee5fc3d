#include "widgets.h"

#include <imgui_internal.h>  // ClearActiveID

#include <algorithm>
#include <utility>

namespace welkin::window {
namespace {

// There is one interface, as in ImGui itself.
std::string g_finished;
std::map<std::string, std::array<float, 4>> g_places;

}  // namespace

void remember(const char* label) {
  const ImVec2 a = ImGui::GetItemRectMin(), b = ImGui::GetItemRectMax();
  if (ImGui::IsItemVisible()) g_places[label] = {a.x, a.y, b.x, b.y};
}

std::string takeFinishedEdit() { return std::exchange(g_finished, {}); }
const std::map<std::string, std::array<float, 4>>& fieldPlaces() { return g_places; }
void markEdit(const char* label) { g_finished = label; }
void beginFields() { g_places.clear(); }

void explain(const char* text) {
  if (!text || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

Edited number(const char* label, double& value, double loaded, const Range& range, const char* explanation) {
  Edited edited;
  const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | (range.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  edited.now = ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &range.low, &range.high, range.format, flags);
  edited.finished = ImGui::IsItemDeactivatedAfterEdit();
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) {
    value = std::clamp(loaded, range.low, range.high);
    ImGui::ClearActiveID();  // else the slider would follow the mouse again
    edited = {true, true};
  }
  if (edited.finished) g_finished = label;
  remember(label);
  if (!ImGui::IsItemActive()) explain(explanation);
  return edited;
}

bool choice(const char* label, int& index, std::span<const char* const> names, const char* explanation) {
  const bool changed = ImGui::Combo(label, &index, names.data(), int(names.size()));
  if (changed) g_finished = label;
  remember(label);
  explain(explanation);
  return changed;
}

bool tick(const char* label, bool& value, const char* explanation) {
  const bool changed = ImGui::Checkbox(label, &value);
  if (changed) g_finished = label;
  remember(label);
  explain(explanation);
  return changed;
}

bool radio(const char* label, bool on, const char* explanation) {
  const bool chosen = ImGui::RadioButton(label, on);
  remember(label);
  explain(explanation);
  return chosen;
}

bool press(const char* label, const char* explanation) {
  const bool pressed = ImGui::Button(label);
  remember(label);
  explain(explanation);
  return pressed;
}

void line(const std::string& name, const std::string& value) {
  ImGui::TextDisabled("%s", name.c_str());
  ImGui::SameLine(ImGui::GetFontSize() * 9);
  ImGui::TextUnformatted(value.c_str());
}

}  // namespace welkin::window
