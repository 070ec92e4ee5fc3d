#include "widgets.h"

#include <imgui_internal.h>  // ClearActiveID

#include <algorithm>

namespace welkin::window {

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
  if (!ImGui::IsItemActive()) explain(explanation);
  return edited;
}

bool choice(const char* label, int& index, std::span<const char* const> names, const char* explanation) {
  const bool changed = ImGui::Combo(label, &index, names.data(), int(names.size()));
  explain(explanation);
  return changed;
}

bool tick(const char* label, bool& value, const char* explanation) {
  const bool changed = ImGui::Checkbox(label, &value);
  explain(explanation);
  return changed;
}

void line(const std::string& name, const std::string& value) {
  ImGui::TextDisabled("%s", name.c_str());
  ImGui::SameLine(ImGui::GetFontSize() * 9);
  ImGui::TextUnformatted(value.c_str());
}

}  // namespace welkin::window
