#include "viewer/window/overlay.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <array>
#include <numbers>
#include <string>

#include "viewer/options/occluder_parameters.h"
#include "viewer/options/occlusion_parameters.h"
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

/// Radio buttons of an enumeration in the order of `names`.
template <typename T, std::size_t count>
void drawChoice(const std::array<const char*, count>& names, T& value) {
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) ImGui::SameLine();
    if (ImGui::RadioButton(names[i], static_cast<std::size_t>(value) == i)) value = static_cast<T>(i);
  }
}

/// A slider for each number of options.
template <typename Options>
void drawParameters(std::span<const OptionParameter<Options>> parameters, Options& options) {
  for (const OptionParameter<Options>& parameter : parameters) {
    auto value = static_cast<float>(parameter.get(options));
    if (ImGui::SliderFloat(parameter.label, &value, static_cast<float>(parameter.usualLeast),
                           static_cast<float>(parameter.usualMost), parameter.isWhole ? "%.0f" : "%.2f"))
      parameter.set(options, value);
  }
}

void drawOccluders(Controls& controls) {
  if (controls.view().shading != Shading::Vo) return;
  OccluderOptions options = controls.view().occluders;
  drawChoice(std::array{"soft", "thesis"}, options.shading.formula);
  ImGui::PushID("mirrors");
  drawChoice(std::array{"mirrors by lobes", "thesis"}, options.shading.mirrors);
  ImGui::PopID();
  drawChoice(std::array{"lambert", "oren-nayar"}, options.shading.receiver);
  ImGui::Checkbox("all highlights", &options.allHighlights);
  drawParameters(occluderParameters(), options);
  ImGui::SliderInt("sky lights", &options.skyLights, 1, 256);
  controls.setOccluders(options);
}

void drawScreenOcclusion(Controls& controls) {
  if (controls.view().shading != Shading::Screen) return;
  ScreenOcclusionOptions options = controls.view().screenOcclusion;
  drawChoice(std::array{"ssao", "hbao", "gtao", "ssdo", "disks", "fields"}, options.method);
  ImGui::Checkbox("filtered", &options.filtered);
  drawParameters(screenOcclusionParameters(), options);
  controls.setScreenOcclusion(options);
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
  drawOccluders(controls);
  drawScreenOcclusion(controls);
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
