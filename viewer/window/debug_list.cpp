#include "viewer/window/debug_list.h"

#include <imgui.h>

namespace prelight::viewer {

void drawDebugList(Controls& controls) {
  if (controls.extras().debugViews.size() < 2) return;
  DebugOptions options = controls.view().debug;
  if (ImGui::BeginCombo("debug view", nameOf(options.shown))) {
    for (const DebugView view : controls.extras().debugViews) {
      if (ImGui::Selectable(nameOf(view), view == options.shown)) options.shown = view;
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", debugChoices[static_cast<std::size_t>(view)].help);
    }
    ImGui::EndCombo();
  }
  if (options.shown == DebugView::Tree)
    ImGui::SliderInt("tree depth", &options.treeDepth, 0, DebugOptions::deepestTree);
  controls.setDebug(options);
}

}  // namespace prelight::viewer
