#include "viewer/overlay.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <array>
#include <numbers>
#include <string>

namespace prelight::viewer {
namespace {

constexpr const char* help =
    "left drag          orbit\n"
    "middle drag        pan (also Ctrl + left drag)\n"
    "wheel              zoom\n"
    "right drag         move the selected light around the scene\n"
    "right + wheel      its distance\n"
    "Tab, L             next light, add a light\n"
    "Shift + left drag  turn the sky (also Q and E)\n"
    "1 2 3              phong, ao, sh\n"
    "R                  first view\n"
    "H                  this help\n"
    "Esc                quit";

void drawShadings(Controls& controls) {
  constexpr std::array<Shading, 3> shadings = {Shading::Phong, Shading::Ao, Shading::Sh};
  for (const Shading shading : shadings) {
    if (!controls.canShade(shading)) continue;
    if (shading != Shading::Phong) ImGui::SameLine();
    const std::string name(shadingName(shading));
    if (ImGui::RadioButton(name.c_str(), controls.view().shading == shading)) controls.setShading(shading);
  }
}

void drawLights(Controls& controls) {
  const auto& lights = controls.view().lights;
  if (ImGui::Button("Add light")) controls.run(Command::AddLight);
  if (controls.selectedLight() < 0) return;
  const Light& light = lights[controls.selectedLight()];
  ImGui::SameLine();
  if (ImGui::Button("Next")) controls.run(Command::NextLight);
  ImGui::SameLine();
  ImGui::Text("%d/%d %s", controls.selectedLight() + 1, static_cast<int>(lights.size()), light.name.c_str());
  glm::vec3 intensity = light.intensity;
  if (ImGui::DragFloat3(light.type == LightType::Directional ? "W/m2" : "W/sr", &intensity.x, 0.05f, 0.0f,
                        1e6f)) {
    controls.setLightIntensity(intensity);
  }
}

}  // namespace

Overlay::Overlay(GLFWwindow* window) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // leaves no file behind
  ImGui::StyleColorsDark();
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 410 core");
}

Overlay::~Overlay() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Overlay::draw(Controls& controls, double frameSeconds) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  ImGui::SetNextWindowPos(ImVec2(8.0f, 8.0f));
  ImGui::SetNextWindowBgAlpha(0.7f);
  ImGui::Begin("prelight", nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar);
  ImGui::Text("%.1f ms a frame   H: help", 1e3 * frameSeconds);
  drawShadings(controls);
  auto degrees = static_cast<float>(controls.view().skyRotation * 180.0 / std::numbers::pi);
  if (ImGui::SliderFloat("sky", &degrees, -180.0f, 180.0f, "%.0f deg")) {
    controls.setSkyRotation(degrees * std::numbers::pi / 180.0);
  }
  drawLights(controls);
  if (showHelp_) {
    ImGui::Separator();
    ImGui::TextUnformatted(help);
  }
  ImGui::End();
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Overlay::wantsMouse() const { return ImGui::GetIO().WantCaptureMouse; }

bool Overlay::wantsKeys() const { return ImGui::GetIO().WantTextInput; }

}  // namespace prelight::viewer
