#include "export/exported_lights.h"

#include <algorithm>
#include <array>
#include <string>

#include "export/exported_animations.h"
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

/// Marks a light in its extras. Extras that are no object belong to the scene and stay unchanged.
void mark(Json& light) {
  Json& extras = light["extras"];
  if (!extras.is_null() && !extras.is_object()) return;
  Json& own = extras["prelight"];
  if (own.is_null() || own.is_object()) own["baked"] = true;
}

void removeLights(Json& root, const char* extension) {
  for (Json& node : root["nodes"]) dropExtension(node, extension);
  dropExtension(root, extension);
  dropExtensionName(root, extension);
  const std::string path = std::string("/extensions/") + extension + "/";
  dropChannels(root, [&](const std::string& pointer) { return pointer.find(path) != std::string::npos; });
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
    for (Json& light : root[list]) mark(light);
  }
  return count;
}

}  // namespace prelight
