#include "interface.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "theme.h"

namespace welkin::window {

Interface::Interface(Window& window) : window_(window) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;  // the window captures the mouse itself
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
  ImGui_ImplOpenGL3_Init("#version 450 core");
}

Interface::~Interface() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Interface::dress() {
  useTheme(scale_);
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void Interface::begin() {
  // A large window on a monitor that asks for no scale still gets letters that can be read.
  const app::Size size = window_.pixels();
  const double large = std::min(size.width / 2560.0, size.height / 1440.0);
  const double wanted = asked_ > 0 ? asked_ : std::max(window_.scale(), std::floor(large * 4) / 4);
  if (wanted != scale_) {
    scale_ = wanted;
    dress();
  }
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  // Of two clicks within a slow frame, each press and release is given a frame of its own.
  ImGui::GetIO().MouseDoubleClickTime = std::max(0.4f, 4 * ImGui::GetIO().DeltaTime);
  if (window_.mouseCaptured()) ImGui::GetIO().MousePos = {-FLT_MAX, -FLT_MAX};
  ImGui::NewFrame();
}

void Interface::end() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Interface::wantsMouse() const { return ImGui::GetIO().WantCaptureMouse && !window_.mouseCaptured(); }
bool Interface::busy() const { return ImGui::IsAnyItemActive(); }
bool Interface::wantsKeys() const { return ImGui::GetIO().WantTextInput; }

}  // namespace welkin::window
