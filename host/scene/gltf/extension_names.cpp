#include "scene/gltf/extension_names.h"

#include <algorithm>

namespace prelight {

using Json = nlohmann::ordered_json;

void useExtensionName(Json& root, std::string_view name) {
  Json& used = root["extensionsUsed"];
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

void dropExtensionName(Json& root, std::string_view name) {
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    if (!root.contains(list)) continue;
    Json kept = Json::array();
    for (const Json& entry : root[list])
      if (entry != name) kept.push_back(entry);
    if (kept.empty())
      root.erase(list);
    else
      root[list] = std::move(kept);
  }
}

}  // namespace prelight
