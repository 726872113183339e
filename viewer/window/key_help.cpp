#include "viewer/window/key_help.h"

#include <array>
#include <string_view>

#include "viewer/core/shading.h"

namespace prelight::viewer {
namespace {

constexpr std::array numberKeys = {1, 2, 3, 4, 5, 6, 7, 8, 9, 0};

std::string line(std::string_view key, std::string_view action) {
  constexpr std::size_t keyWidth = 19;
  std::string text(key);
  text.append(key.size() < keyWidth ? keyWidth - key.size() : 1, ' ');
  return text.append(action);
}

/// "1 phong, 3 sh"
std::string shadingKeys(const Controls& controls) {
  std::string keys;
  for (const int digit : numberKeys) {
    const Shading shading = shadingOfKey(digit);
    if (!controls.canShade(shading)) continue;
    keys += (keys.empty() ? "" : ", ") + std::to_string(digit) + " " + std::string(shadingName(shading));
  }
  return keys;
}

void addNodeKeys(const Controls& controls, std::vector<std::string>& lines) {
  const bool full = controls.canShade(Shading::GlobalIllumination), vo = controls.canShade(Shading::Vo);
  const bool objects = controls.extras().objects;
  if (!full && !vo && !objects) return;
  if (controls.nodes().size() > 1) lines.push_back(line("N", "next node"));
  if (objects) {
    lines.push_back(line("Shift + right drag", "move the selected node; objects are lit where they are"));
    return;
  }
  const char* shadings = full && vo ? "full and vo" : full ? "full" : "vo";
  lines.push_back(
      line("Shift + right drag", std::string("move the selected node (") + shadings + " shading)"));
}

}  // namespace

Shading shadingOfKey(int digit) { return shadings()[static_cast<std::size_t>((digit + 9) % 10)].shading; }

std::vector<std::string> keyHelp(const Controls& controls, bool hasSky) {
  std::vector<std::string> lines = {
      line("left drag", "orbit"), line("middle drag", "pan (also Ctrl + left drag)"), line("wheel", "zoom")};
  if (controls.selectedLight() >= 0) {
    lines.push_back(line("right drag", "move the selected light around the scene"));
    lines.push_back(line("right + wheel", "its distance"));
  }
  if (controls.view().lights.size() > 1) lines.push_back(line("Tab", "next light"));
  lines.push_back(line("L", "add a light"));
  if (hasSky) lines.push_back(line("Shift + left drag", "turn the sky (also Q and E)"));
  if (!controls.nodes().empty()) addNodeKeys(controls, lines);
  if (controls.playback().exists()) {
    lines.push_back(line("Space", "play or pause the animation"));
    lines.push_back(line("Left, Right", "a frame of it back, on"));
    lines.push_back(line("[ and ]", "play slower, faster"));
    lines.push_back(line("Home", "to its start"));
  }
  lines.push_back(line("number keys", shadingKeys(controls)));
  if (controls.canShade(Shading::GlobalIllumination)) lines.push_back(line("F", "full shading"));
  if (controls.canShade(controls.groupShading()) && !controls.groups().empty()) {
    if (controls.groups().size() > 1) lines.push_back(line("G", "next light group"));
    lines.push_back(line("PgUp, PgDn", "selected light group brighter, dimmer"));
  }
  if (controls.extras().probes) lines.push_back(line("P", "show or hide probes"));
  if (controls.extras().debugViews.size() > 1)
    lines.push_back(line("V", "next debug view, after the last one the picture"));
  lines.push_back(line("R", "first view"));
  lines.push_back(line("H", "this help"));
  lines.push_back(line("Esc", "quit"));
  return lines;
}

}  // namespace prelight::viewer
