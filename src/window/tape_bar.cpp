#include "tape_bar.h"

#include <algorithm>
#include <cmath>

#include "widgets.h"

namespace welkin::window {
namespace {

enum class Held { None, Place, In, Out };
Held g_held = Held::None;  // there is one bar, and one mouse

constexpr ImU32 kAway = IM_COL32(26, 38, 56, 230), kKept = IM_COL32(58, 92, 130, 255), kPoint = IM_COL32(242, 180, 90, 255),
                kPlace = IM_COL32(221, 229, 240, 255), kTick = IM_COL32(132, 147, 168, 110);

double tickStep_s(double whole_s) {  // 1, 2 or 5 of a power of ten: about ten of them
  const double raw = whole_s / 10, power = std::pow(10, std::floor(std::log10(raw)));
  return raw < 2 * power ? 2 * power : (raw < 5 * power ? 5 * power : 10 * power);
}

}  // namespace

bool tapeBar(Deck& deck) {
  const float letters = ImGui::GetFontSize();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float edge = 0.5f * letters, width = std::max(ImGui::GetContentRegionAvail().x, 4 * edge), height = 2.2f * letters;
  const float left = at.x + edge, run = width - 2 * edge, bottom = at.y + height, middle = at.y + 0.55f * height;
  const double whole_s = std::max(deck.tape.duration_s(), 1e-9), step_s = deck.tape.step_s();
  const auto x = [&](double s) { return left + run * float(std::clamp(s / whole_s, 0.0, 1.0)); };
  const float in = x(deck.in_s()), out = x(deck.out_s());

  ImGui::InvisibleButton("bar", {width, height});
  remember("flight bar");
  const bool active = ImGui::IsItemActive();
  const ImVec2 mouse = ImGui::GetMousePos();
  const bool nearIn = std::abs(mouse.x - in) <= std::abs(mouse.x - out) && (in < out || mouse.x <= in);
  if (ImGui::IsItemHovered() && !active) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  bool moved = false;
  if (ImGui::IsItemActivated()) {
    g_held = mouse.y < middle ? Held::Place : (nearIn ? Held::In : Held::Out);
  }
  if (active) {
    const double s = std::clamp(double((mouse.x - left) / run), 0.0, 1.0) * whole_s;
    const int frame = int(std::lround(s / step_s));
    const bool reset = ImGui::IsMouseDoubleClicked(0);
    if (g_held == Held::In) reset ? deck.tape.setIn(0) : deck.tape.setIn(frame);
    if (g_held == Held::Out) reset ? deck.tape.setOut(deck.tape.frames() - 1) : deck.tape.setOut(frame);
    if (g_held == Held::Place) deck.moveTo(frame * step_s), moved = true;
    if (reset && g_held != Held::Place) g_held = Held::None;  // else it would follow the mouse again
  }
  if (ImGui::IsItemDeactivated()) deck.tape.letGo();
  if (!active)
    explain("Drag above to move along the flight, below to set the in and out points. A double click below brings a point back.");

  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float round = 0.25f * letters;
  draw.AddRectFilled({left, at.y + 2}, {left + run, bottom - 2}, kAway, round);
  draw.AddRectFilled({in, at.y + 2}, {std::max(out, in + 1), bottom - 2}, kKept, round);
  for (double s = 0, step = tickStep_s(whole_s); s <= whole_s * 1.0001; s += step)
    draw.AddLine({x(s), bottom - 0.4f * letters}, {x(s), bottom - 2}, kTick);
  const auto point = [&](float px, float way) {  // a bracket that opens towards what is kept
    draw.AddLine({px, at.y + 2}, {px, bottom - 2}, kPoint, 0.13f * letters);
    draw.AddTriangleFilled({px, bottom - 0.95f * letters}, {px, bottom - 1}, {px + way * 0.55f * letters, bottom - 1}, kPoint);
  };
  point(in, 1), point(out, -1);
  const float place = x(deck.at_s());
  draw.AddLine({place, at.y}, {place, bottom}, kPlace, 0.13f * letters);
  draw.AddCircleFilled({place, at.y + 0.35f * letters}, 0.32f * letters, kPlace);
  return moved;
}

}  // namespace welkin::window
