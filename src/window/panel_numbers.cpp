#include "log_lines.h"
#include "panels.h"
#include "welkin/core/units.h"
#include "widgets.h"

namespace welkin::window {
namespace {

std::string msText(double ms) { return ms < 100 ? fmt::format("{:.1f}", ms) : fmt::format("{:.0f}", ms); }

void plot(const std::string& name, const FrameTimes::Row& row, int next, float height) {
  const float top = std::max(float(row.greatest()) * 1.15f, 1.0f);
  ImGui::PlotLines(("##" + name).c_str(), row.ms.data(), int(row.ms.size()), next, nullptr, 0, top,
                   {ImGui::GetContentRegionAvail().x * 0.55f, height});
  ImGui::SameLine();
  ImGui::BeginGroup();
  ImGui::TextUnformatted(name.c_str());
  ImGui::TextDisabled("%s ms, at most %s", msText(row.median()).c_str(), msText(row.greatest()).c_str());
  ImGui::EndGroup();
}

}  // namespace

void profilerPanel(Model& model) {
  const float two = 2 * ImGui::GetTextLineHeightWithSpacing();
  plot("frame", model.times.frame(), model.times.next(), two);
  for (const auto& [name, row] : model.times.passes()) plot(name, row, model.times.next(), two);
  const FrameCounters& c = model.stats.counters;
  line("marched", fmt::format("{} pixels, {} new in sight", c.marchedPixels, c.rejectedPixels));
  line("a ray", c.marchedPixels ? fmt::format("{:.1f} cells, {:.1f} samples", double(c.cells) / double(c.marchedPixels),
                                              double(c.samples) / double(c.marchedPixels))
                                : "none");
  line("not a number", fmt::format("{} pixels, {} holes", c.nanPixels, c.holes));
  line("worker", fmt::format("{} bricks made, {} lit", model.stats.bricksGenerated, model.stats.bricksLit));
  line("GL", model.device);
}

void memoryPanel(Model& model) {
  const FrameStats& s = model.stats;
  const auto share = [](double part, double whole) { return whole > 0 ? float(part / whole) : 0.0f; };
  ImGui::ProgressBar(share(double(s.bytesUsed), double(s.bytesBudget)), {-1, 0},
                     fmt::format("{} of {}", bytesText(s.bytesUsed), bytesText(s.bytesBudget)).c_str());
  explain("bytes in use of the budget");
  ImGui::ProgressBar(share(s.residency.bricks, s.residency.brickCapacity), {-1, 0},
                     fmt::format("{} of {} bricks", s.residency.bricks, s.residency.brickCapacity).c_str());
  explain("bricks of the octree that are there");
  line("waiting", fmt::format("{} bricks{}", s.residency.pendingBricks, s.residency.settled ? ", all is there" : ""));
  line("detail", fmt::format("{:.0f} nodes a radian of {:.0f}", s.sampleDetail, s.residency.selectedDetail));
  line("nodes", fmt::format("{}, {} empty", s.residency.nodes, s.residency.emptyNodes));
  line("pictures", bytesText(s.frameTargetBytes) + ", beside the budget");
  line("mirror", bytesText(s.residency.cpuBytes) + " on the CPU");
  std::vector<float> levels;
  for (const auto n : s.residency.bricksByLevel) levels.push_back(float(n));
  while (levels.size() > 1 && levels.back() == 0) levels.pop_back();
  ImGui::TextDisabled("bricks by level of the octree");
  ImGui::PlotHistogram("##levels", levels.data(), int(levels.size()), 0, nullptr, 0, FLT_MAX,
                       {ImGui::GetContentRegionAvail().x, 4 * ImGui::GetTextLineHeightWithSpacing()});
  if (!model.painted || !ImGui::TreeNode("what takes it")) return;
  for (const auto& [name, bytes] : model.painted->memory) line(name, bytesText(bytes));
  ImGui::TreePop();
}

void leftOutPanel(Model& model) {
  if (!model.painted) return;
  const FramePlan& plan = model.painted->plan;
  ImGui::PushTextWrapPos(0);
  std::string passes;
  for (const auto& pass : plan.passes) passes += (passes.empty() ? "" : ", ") + pass;
  ImGui::TextWrapped("Every frame: %s.", passes.c_str());
  if (!model.stats.leftOut.empty()) ImGui::TextWrapped("Left out of this frame: %s.", model.stats.leftOut.c_str());
  for (const LeftOut& left : plan.leftOut) {
    ImGui::Bullet();
    ImGui::TextWrapped("%s: %s", left.what.c_str(), left.reason.c_str());
  }
  if (!plan.skyModel.empty()) ImGui::TextWrapped("Sky: %s (%s).", plan.skyModel.c_str(), plan.skyReason.c_str());
  for (const auto& note : model.painted->notes) ImGui::TextWrapped("%s", note.c_str());
  ImGui::PopTextWrapPos();
}

void logPanel(Model&) {
  ImGui::BeginChild("lines", {0, 12 * ImGui::GetTextLineHeightWithSpacing()}, true);
  ImGui::PushTextWrapPos(0);
  for (const auto& text : LogLines::last())
    ImGui::TextUnformatted(text.c_str(), text.c_str() + std::min(text.size(), text.find_last_not_of('\n') + 1));
  if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY()) ImGui::SetScrollHereY(1);
  ImGui::PopTextWrapPos();
  ImGui::EndChild();
}

}  // namespace welkin::window
