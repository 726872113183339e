#include "viewer/window/overlay.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "viewer/options/shading_options.h"
#include "viewer/window/debug_list.h"
#include "viewer/window/key_help.h"

namespace prelight::viewer {
namespace {

void drawShadings(Controls& controls) {
  for (const ShadingInfo& info : shadings()) {
    if (!controls.canShade(info.shading)) continue;
    if (info.shading != Shading::Phong) ImGui::SameLine();
    const std::string name(info.name());
    if (ImGui::RadioButton(name.c_str(), controls.view().shading == info.shading))
      controls.setShading(info.shading);
  }
}

void drawSky(Controls& controls) {
  auto degrees = static_cast<float>(controls.view().skyRotation * 180.0 / std::numbers::pi);
  if (ImGui::SliderFloat("sky", &degrees, -180.0f, 180.0f, "%.0f deg"))
    controls.setSkyRotation(degrees * std::numbers::pi / 180.0);
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
  const char* unit = light.profile != nullptr               ? "x profile"
                     : light.type == LightType::Directional ? "W/m2"
                     : light.type == LightType::Area        ? "W/(m2 sr)"
                                                            : "W/sr";
  if (ImGui::DragFloat3(unit, &intensity.x, 0.05f, 0.0f, 1e6f)) {
    controls.setLightIntensity(intensity);
  }
}

void drawNodes(Controls& controls) {
  if (!controls.nodesMoveNow() || controls.selectedNode() < 0) return;
  if (!ImGui::BeginCombo("node", controls.nodes()[controls.selectedNode()].name.c_str())) return;
  for (int i = 0; i < static_cast<int>(controls.nodes().size()); ++i) {
    ImGui::PushID(i);
    if (ImGui::Selectable(controls.nodes()[i].name.c_str(), i == controls.selectedNode()))
      controls.selectNode(i);
    ImGui::PopID();
  }
  ImGui::EndCombo();
}

void drawTimeline(Controls& controls) {
  const Playback& playback = controls.playback();
  if (!playback.exists()) return;
  ImGui::Separator();
  if (ImGui::Button(playback.plays() ? "Pause" : "Play")) controls.run(Command::PlayOrPause);
  ImGui::SameLine();
  bool loops = playback.loops();
  if (ImGui::Checkbox("loop", &loops)) controls.setLoop(loops);
  ImGui::SameLine();
  if (playback.animations().size() < 2) {
    ImGui::TextUnformatted(playback.animations()[playback.chosen()].name.c_str());
  } else if (ImGui::BeginCombo("animation", playback.animations()[playback.chosen()].name.c_str())) {
    for (std::size_t i = 0; i < playback.animations().size(); ++i) {
      ImGui::PushID(static_cast<int>(i));
      if (ImGui::Selectable(playback.animations()[i].name.c_str(), i == playback.chosen()))
        controls.choosePlayed(i);
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  auto seconds = static_cast<float>(playback.seconds());
  if (ImGui::SliderFloat("time", &seconds, static_cast<float>(playback.start()),
                         static_cast<float>(playback.end()), "%.2f s"))
    controls.seek(seconds);
  auto speed = static_cast<float>(playback.speed());
  if (ImGui::SliderFloat("speed", &speed, -2.0f, 2.0f, "%.2f")) controls.setSpeed(speed);
}

void drawGroups(Controls& controls) {
  if (controls.view().shading != controls.groupShading() || controls.selectedGroup() < 0) return;
  if (ImGui::BeginCombo("group", controls.groups()[controls.selectedGroup()].c_str())) {
    for (int g = 0; g < static_cast<int>(controls.groups().size()); ++g) {
      ImGui::PushID(g);
      if (ImGui::Selectable(controls.groups()[g].c_str(), g == controls.selectedGroup()))
        controls.selectGroup(g);
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  glm::vec3 factor = controls.view().groupFactors[controls.selectedGroup()];
  if (ImGui::DragFloat3("factor", &factor.x, 0.02f, 0.0f, 1e6f)) controls.setGroupFactor(factor);
}

/// Returns the words of an option's name, with its unit: "occlusion radius, m".
std::string labelOf(const OptionInfo& row) {
  std::string label = row.name;
  std::replace(label.begin(), label.end(), '-', ' ');
  return *row.unit == '\0' ? label : label + ", " + row.unit;
}

void drawChoice(const Option<ShadingOptions>& row, ShadingOptions& options) {
  const auto chosen = static_cast<std::size_t>(row.get(options).value_or(0.0));
  if (!ImGui::BeginCombo(labelOf(row).c_str(), row.choices[chosen].name)) return;
  for (std::size_t i = 0; i < row.choices.size(); ++i)
    if (ImGui::Selectable(row.choices[i].name, i == chosen)) row.set(options, static_cast<double>(i));
  ImGui::EndCombo();
}

void drawNumber(const Option<ShadingOptions>& row, ShadingOptions& options) {
  const bool usual = row.usual.least < row.usual.most;
  const auto least = static_cast<float>(usual ? row.usual.least : row.range.least);
  const auto most = static_cast<float>(usual ? row.usual.most : row.range.most);
  const bool whole = row.range.kind != NumberKind::Real;
  auto value = static_cast<float>(row.get(options).value_or(0.0));
  if (ImGui::SliderFloat(labelOf(row).c_str(), &value, least, most, whole ? "%.0f" : "%.2f"))
    row.set(options, whole ? std::round(value) : value);
}

void drawOption(const Option<ShadingOptions>& row, ShadingOptions& options) {
  bool flag = row.get(options) == 1.0;
  switch (row.kind) {
    case OptionKind::Flag:
      if (ImGui::Checkbox(labelOf(row).c_str(), &flag)) row.set(options, flag ? 1.0 : 0.0);
      break;
    case OptionKind::Number:
      drawNumber(row, options);
      break;
    case OptionKind::Choice:
      drawChoice(row, options);
      break;
    case OptionKind::Own:
      return;
  }
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", row.help);
}

/// Draws every option of the shading that is shown.
void drawShadingOptions(Controls& controls) {
  ShadingOptions options = controls.view();
  for (const Option<ShadingOptions>& row : optionsOf<ShadingOptions>())
    if (row.appliesTo(shadingName(controls.view().shading))) drawOption(row, options);
  controls.setOptions(options);
}

}  // namespace

Overlay::Overlay(GLFWwindow* window, bool hasSky) : hasSky_(hasSky) {
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
  if (hasSky_) drawSky(controls);
  drawLights(controls);
  drawNodes(controls);
  drawGroups(controls);
  drawShadingOptions(controls);
  drawDebugList(controls);
  drawTimeline(controls);
  if (showHelp_) {
    ImGui::Separator();
    for (const std::string& line : keyHelp(controls, hasSky_)) ImGui::TextUnformatted(line.c_str());
  }
  ImGui::End();
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Overlay::wantsMouse() const { return ImGui::GetIO().WantCaptureMouse; }

bool Overlay::wantsKeys() const { return ImGui::GetIO().WantTextInput; }

}  // namespace prelight::viewer
