#include <algorithm>

#include "panels.h"
#include "widgets.h"

namespace welkin::window {
namespace {

constexpr ImU32 kColours[2] = {IM_COL32(127, 178, 229, 255), IM_COL32(242, 180, 90, 255)};  // A, B

void coloured(int which, const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, kColours[which]);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

std::string hover(const app::FlightResult& r) {
  std::string text = r.file.string();
  for (const auto& [name, value] : r.settings) text += "\n" + name + ": " + value;
  return text;
}

// Which ones are side by side.
void choose(Results& results) {
  for (int i = 0; i < int(results.all.size()); ++i) {
    const app::FlightResult& r = results.all[std::size_t(i)];
    ImGui::PushID(i);
    ImGui::PushStyleColor(ImGuiCol_Text, kColours[0]);
    if (ImGui::RadioButton("A", results.a == i)) results.a = i;
    ImGui::PopStyleColor();
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, kColours[1]);
    if (ImGui::RadioButton("B", results.b == i)) results.b = results.b == i ? -1 : i;
    ImGui::PopStyleColor();
    ImGui::SameLine();
    ImGui::Text("%s, %.1f ms", r.file.filename().string().c_str(), r.median_ms);
    explain(hover(r).c_str());
    ImGui::PopID();
  }
}

void right(const std::string& text, ImU32 colour = ImGui::GetColorU32(ImGuiCol_Text)) {
  const float room = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(room, 0.0f));
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
}

void table(const app::ResultComparison& c, bool both) {
  if (!ImGui::BeginTable("times", both ? 4 : 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return;
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 2.4f);
  for (const char* name : {"A", "B", "B / A"}) {
    if (!both && name[0] == 'B') continue;
    ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_WidthStretch, 1);
  }
  if (both) {
    ImGui::TableNextColumn();
    ImGui::TableNextColumn(), right("A", kColours[0]);
    ImGui::TableNextColumn(), right("B", kColours[1]);
    ImGui::TableNextColumn(), right("B / A", ImGui::GetColorU32(ImGuiCol_TextDisabled));
  }
  for (const app::ComparedRow& row : c.rows) {
    ImGui::TableNextColumn();
    ImGui::Text("%s%s%s", row.name.c_str(), *row.unit != '\0' ? ", " : "", row.unit);
    ImGui::TableNextColumn(), right(app::valueText(row, row.a));
    if (!both) continue;
    ImGui::TableNextColumn(), right(app::valueText(row, row.b));
    ImGui::TableNextColumn(), right(app::ratioText(row));
  }
  ImGui::EndTable();
}

// Frame times over the share of the flight that is behind: paths of unlike length lie over each other.
void plot(const app::FlightResult* const (&results)[2]) {
  const float letters = ImGui::GetFontSize(), width = ImGui::GetContentRegionAvail().x, height = 6 * letters;
  double top = 1e-6;
  for (const auto* r : results)
    if (r) top = std::max(top, r->p99_ms * 1.3);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  ImGui::Dummy({width, height});
  remember("results plot");
  explain("times of the frames, over the share of the flight that is behind; of many frames in one pixel the slowest");
  draw.AddRectFilled(at, {at.x + width, at.y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg), 4);
  draw.PushClipRect(at, {at.x + width, at.y + height}, true);
  std::vector<ImVec2> line;
  for (int k = 0; k < 2; ++k) {
    if (!results[k]) continue;
    const auto& ms = results[k]->frame_ms;
    line.clear();
    const std::size_t points = std::min<std::size_t>(ms.size(), std::size_t(width)), per = (ms.size() + points - 1) / points;
    for (std::size_t i = 0; i < ms.size(); i += per) {  // of many frames the slowest is shown
      const double slowest = *std::max_element(ms.begin() + std::ptrdiff_t(i), ms.begin() + std::ptrdiff_t(std::min(i + per, ms.size())));
      const double part = ms.size() > 1 ? double(i) / double(ms.size() - 1) : 0;
      line.push_back({at.x + width * float(part), at.y + height * float(1 - slowest / top)});
    }
    draw.AddPolyline(line.data(), int(line.size()), kColours[k], 0, 0.1f * letters);
  }
  draw.PopClipRect();
  const std::string scale = fmt::format("{:.3g} ms", top);
  draw.AddText({at.x + 6, at.y + 3}, ImGui::GetColorU32(ImGuiCol_TextDisabled), scale.c_str());
  for (int k = 0; k < 2; ++k)
    if (results[k]) draw.AddText({at.x + width - letters * float(k == 0 ? 3 : 1.5), at.y + 3}, kColours[k], k == 0 ? "A" : "B");
}

void differences(const app::ResultComparison& c) {
  if (c.different.empty()) {
    ImGui::TextDisabled("same settings, scene and device");
    return;
  }
  ImGui::TextDisabled("different");
  const float letters = ImGui::GetFontSize(), room = ImGui::GetContentRegionAvail().x;
  ImGui::PushTextWrapPos(0);
  for (const auto& d : c.different) {
    ImGui::TextUnformatted(d.name.c_str());
    const bool narrow = std::max(ImGui::CalcTextSize(d.a.c_str()).x, ImGui::CalcTextSize(d.b.c_str()).x) < 0.28f * room;
    if (narrow) {
      ImGui::SameLine(0.42f * room), coloured(0, d.a);
      ImGui::SameLine(0.74f * room), coloured(1, d.b);
      continue;
    }
    ImGui::Indent(letters);
    coloured(0, d.a);
    coloured(1, d.b);
    ImGui::Unindent(letters);
  }
  ImGui::PopTextWrapPos();
}

}  // namespace

void resultsPanel(Model& model) {
  Results& results = model.results;
  if (results.all.empty()) {
    ImGui::PushTextWrapPos(0);
    ImGui::TextDisabled("Benchmarks of flights are shown here, one alone or two side by side. Results of `welkin fly` can be dropped too.");
    ImGui::PopTextWrapPos();
    return;
  }
  choose(results);
  if (results.a < 0) return;
  const app::FlightResult& a = results.all[std::size_t(results.a)];
  const app::FlightResult* b = results.b >= 0 ? &results.all[std::size_t(results.b)] : nullptr;
  const app::ResultComparison c = app::compareResults(a, b ? *b : a);
  plot({&a, b});
  table(c, b != nullptr);
  if (b) differences(c);
}

}  // namespace welkin::window
