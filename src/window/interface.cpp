#include "interface.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "theme.h"

namespace welkin::window {

Interface::Interface(Window& window) : window_(window) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().MouseDoubleClickTime = 0.4f;
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
  if (window_.scale() != scale_) {
    scale_ = window_.scale();
    dress();
  }
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
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
