#include "export/exported_lights.h"

#include <algorithm>
#include <array>
#include <string>

#include "scene/gltf/extension_names.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 2> lightExtensions = {"KHR_lights_punctual", "EXT_lights_ies"};

void dropExtension(Json& object, const char* name) {
  if (!object.contains("extensions")) return;
  object["extensions"].erase(name);
  if (object["extensions"].empty()) object.erase("extensions");
}

bool pointsTo(const Json& channel, const std::string& extension) {
  const Json::json_pointer pointer("/target/extensions/KHR_animation_pointer/pointer");
  if (!channel.contains(pointer) || !channel[pointer].is_string()) return false;
  return channel[pointer].get<std::string>().starts_with("/extensions/" + extension + "/");
}

/// Animations need a channel; one that is left without any goes.
void dropChannels(Json& root, const std::string& extension) {
  if (!root.contains("animations")) return;
  Json animations = Json::array();
  for (Json& animation : root["animations"]) {
    Json channels = Json::array();
    for (Json& channel : animation["channels"])
      if (!pointsTo(channel, extension)) channels.push_back(channel);
    if (channels.empty()) continue;
    animation["channels"] = std::move(channels);
    animations.push_back(std::move(animation));
  }
  if (animations.empty())
    root.erase("animations");
  else
    root["animations"] = std::move(animations);
}

void removeLights(Json& root, const char* extension) {
  for (Json& node : root["nodes"]) dropExtension(node, extension);
  dropExtension(root, extension);
  dropExtensionName(root, extension);
  dropChannels(root, extension);
}

}  // namespace

std::size_t exportLights(GltfDocument& document, BakedLights lights) {
  Json& root = document.json;
  std::size_t count = 0;
  for (const char* extension : lightExtensions) {
    const Json::json_pointer list(std::string("/extensions/") + extension + "/lights");
    if (!root.contains(list)) continue;
    count += root[list].size();
    if (lights == BakedLights::Remove) removeLights(root, extension);
    if (lights != BakedLights::Mark) continue;
    for (Json& light : root[list]) light["extras"]["prelight"]["baked"] = true;
  }
  return count;
}

}  // namespace prelight
