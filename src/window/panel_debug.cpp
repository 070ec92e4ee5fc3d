#include <cmath>

#include "panels.h"
#include "welkin/shared/debug.glsl.h"
#include "widgets.h"

namespace welkin::window {
namespace {

constexpr std::array<const char*, kDebugViewNames.size()> kLabels{"picture", "steps", "level of detail", "occupancy", "history",
                                                                  "density", "light", "air only",        "NaN"};

ImU32 colourOf(glm::vec3 c) { return ImGui::GetColorU32({c.x, c.y, c.z, 1}); }

std::string tickText(const DebugTopic& topic, double value) {
  return *topic.unit ? fmt::format("{:.3g}", value) : fmt::format("{:.0f} %", 100 * value);
}

// The scale from end to end, its ticks, and below it how far the picture's values reach, with a dot at their mean.
void scale(const DebugTopic& topic, const DebugNumbers& n) {
  constexpr int kPieces = 128, kTicks = 4;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float letter = ImGui::GetFontSize(), bar = 1.2f * letter, inset = 1.5f * letter,
              width = ImGui::GetContentRegionAvail().x - 2 * inset;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float left = at.x + inset;
  for (int i = 0; i < kPieces; ++i) {
    const float x = left + width * float(i) / kPieces;
    draw.AddRectFilled({x, at.y}, {x + width / kPieces + 1, at.y + bar}, colourOf(shared::scaleColour((float(i) + 0.5f) / kPieces)));
  }
  const ImU32 text = ImGui::GetColorU32(ImGuiCol_Text), grey = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  const auto place = [&](double value) {
    return left + width * std::clamp(shared::debugPlace(unsigned(n.view), float(value)), 0.0f, 1.0f);
  };
  const float reach = at.y + bar + 0.35f * letter;
  if (n.pixels) {
    draw.AddLine({place(n.minimum), reach}, {place(n.maximum), reach}, text, 0.12f * letter);
    draw.AddCircleFilled({place(n.mean), reach}, 0.24f * letter, text);
  }
  for (int i = 0; i <= kTicks; ++i) {
    const double share = double(i) / kTicks;
    const double value =
        topic.logarithmic ? topic.low * std::pow(topic.high / topic.low, share) : topic.low + (topic.high - topic.low) * share;
    const std::string label = tickText(topic, value);
    const float x = left + width * float(share);
    draw.AddLine({x, at.y + bar}, {x, reach + 0.25f * letter}, grey);
    draw.AddText({x - ImGui::CalcTextSize(label.c_str()).x / 2, reach + 0.35f * letter}, grey, label.c_str());
  }
  ImGui::Dummy({width, bar + 2 * letter});
  if (*topic.unit) ImGui::TextDisabled("%s", topic.unit);
}

void swatch(glm::vec3 colour, const std::string& name, std::uint64_t pixels, std::uint64_t all) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float size = ImGui::GetTextLineHeight();
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + size, at.y + size}, colourOf(colour), 0.2f * size);
  ImGui::Dummy({size, size});
  ImGui::SameLine();
  ImGui::Text("%s", name.c_str());
  ImGui::SameLine(ImGui::GetFontSize() * 16);
  if (pixels > 0 && 1000 * pixels < all)  // few, but not none
    ImGui::TextDisabled("%llu pixels", static_cast<unsigned long long>(pixels));
  else
    ImGui::TextDisabled("%.1f %%", 100 * double(pixels) / double(all));
}

}  // namespace

void debugPanel(Model& model) {
  for (std::size_t i = 0; i < kLabels.size(); ++i) {
    if (i % 3) ImGui::SameLine(ImGui::GetFontSize() * 8 * float(i % 3));
    if (radio(kLabels[i], model.debug == DebugView(i), debugTopic(DebugView(i)).what)) model.debug = DebugView(i);
  }
  if (model.debug == DebugView::None) return;
  const DebugTopic& topic = debugTopic(model.debug);
  ImGui::TextWrapped("%s", topic.what);
  if (!model.painted || !model.painted->debug || model.painted->debug->view != model.debug) {
    ImGui::TextDisabled("preparing ...");
    return;
  }
  const DebugNumbers& n = *model.painted->debug;
  const std::uint64_t all = n.pixels + n.without + n.nan;
  if (all == 0) {
    ImGui::TextDisabled("nothing but the background is seen: nothing was drawn");
    return;
  }
  if (topic.high > topic.low) scale(topic, n);
  for (unsigned i = 0; i < topic.kinds; ++i)
    if (n.kinds[i] > 0 || model.debug != DebugView::Detail)
      swatch(shared::debugColour(unsigned(model.debug), float(i)), debugKindName(model.debug, i), n.kinds[i], all);
  if (n.without > 0) swatch(shared::kDebugNoneColour, "none on the ray", n.without, all);
  if (n.nan > 0) swatch(shared::kNanPaint, "not a number", n.nan, all);
  if (n.pixels == 0 || (topic.kinds > 0 && model.debug != DebugView::Detail)) return;
  line("least", debugValueText(topic, n.minimum));
  line("mean", debugValueText(topic, n.mean));
  line("greatest", debugValueText(topic, n.maximum));
}

}  // namespace welkin::window
