#include "theme.h"

#include <imgui.h>

#include <array>
#include <filesystem>

namespace welkin::window {
namespace {

constexpr double kLetters_px = 15;

// The first of these that the machine has; without any ImGui's own pixel letters.
constexpr std::array kFonts{"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
                            "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                            "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
                            "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf"};

void loadLetters(double scale) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  const auto size = float(kLetters_px * scale);
  for (const char* font : kFonts) {
    std::error_code ec;
    if (std::filesystem::exists(font, ec) && atlas.AddFontFromFileTTF(font, size)) return;
  }
  ImFontConfig config;
  config.SizePixels = float(13 * scale);
  atlas.AddFontDefault(&config);
}

ImVec4 colour(unsigned rgb, float alpha = 1) {
  return {float(rgb >> 16 & 255) / 255, float(rgb >> 8 & 255) / 255, float(rgb & 255) / 255, alpha};
}

}  // namespace

void useTheme(double scale) {
  loadLetters(scale);
  ImGuiStyle style;
  ImGui::StyleColorsDark(&style);
  style.WindowPadding = {12, 10};
  style.FramePadding = {7, 4};
  style.ItemSpacing = {8, 6};
  style.ItemInnerSpacing = {6, 4};
  style.WindowRounding = 6, style.FrameRounding = 4, style.GrabRounding = 4, style.ScrollbarRounding = 6, style.PopupRounding = 4;
  style.WindowBorderSize = 0, style.FrameBorderSize = 0, style.PopupBorderSize = 1;
  style.ScrollbarSize = 11, style.GrabMinSize = 11, style.IndentSpacing = 14;
  const unsigned night = 0x0b111c, field = 0x1a2638, raised = 0x24344b, bright = 0x2f4767, sun = 0xf2b45a;
  ImVec4* c = style.Colors;
  c[ImGuiCol_Text] = colour(0xdde5f0);
  c[ImGuiCol_TextDisabled] = colour(0x8493a8);
  c[ImGuiCol_WindowBg] = colour(night, 0.86f);
  c[ImGuiCol_PopupBg] = colour(night, 0.97f);
  c[ImGuiCol_Border] = colour(0x34465f, 0.7f);
  c[ImGuiCol_FrameBg] = colour(field, 0.9f), c[ImGuiCol_FrameBgHovered] = colour(raised), c[ImGuiCol_FrameBgActive] = colour(bright);
  c[ImGuiCol_Header] = colour(field, 0.9f), c[ImGuiCol_HeaderHovered] = colour(raised), c[ImGuiCol_HeaderActive] = colour(bright);
  c[ImGuiCol_Button] = colour(raised), c[ImGuiCol_ButtonHovered] = colour(bright), c[ImGuiCol_ButtonActive] = colour(0x3d5a82);
  c[ImGuiCol_SliderGrab] = colour(0xc9934a, 0.55f), c[ImGuiCol_SliderGrabActive] = colour(sun, 0.7f), c[ImGuiCol_CheckMark] = colour(sun);
  c[ImGuiCol_PlotLines] = colour(0x7fb2e5), c[ImGuiCol_PlotHistogram] = colour(0x5d8fc4);
  c[ImGuiCol_ScrollbarBg] = colour(night, 0), c[ImGuiCol_ScrollbarGrab] = colour(raised), c[ImGuiCol_Separator] = colour(0x2b3b52);
  style.ScaleAllSizes(float(scale));
  ImGui::GetStyle() = style;
}

}  // namespace welkin::window
