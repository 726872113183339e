#include "scene/gltf/load/scale_document.h"

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <map>
#include <set>

namespace prelight {
namespace {

using Json = nlohmann::ordered_json;

void scaleNumbers(Json& object, std::initializer_list<const char*> names, double scale) {
  for (const char* name : names)
    if (const auto found = object.find(name); found != object.end() && found->is_number())
      *found = found->get<double>() * scale;
}

/// Returns the object of an extension, or nullptr.
Json* extensionOf(Json& object, const char* name) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end()) return nullptr;
  const auto found = extensions->find(name);
  return found == extensions->end() || !found->is_object() ? nullptr : &*found;
}

void forEachOf(Json& object, const char* name, const std::function<void(Json&)>& visit) {
  if (const auto found = object.find(name); found != object.end())
    for (Json& element : *found) visit(element);
}

void scaleLengths(Json& json, double scale) {
  forEachOf(json, "materials", [&](Json& material) {
    if (Json* volume = extensionOf(material, "KHR_materials_volume"))
      scaleNumbers(*volume, {"attenuationDistance"}, scale);
  });
  forEachOf(json, "cameras", [&](Json& camera) {
    for (const char* type : {"perspective", "orthographic"})
      if (const auto lens = camera.find(type); lens != camera.end())
        scaleNumbers(*lens, {"znear", "zfar", "xmag", "ymag"}, scale);
  });
  if (Json* lights = extensionOf(json, "KHR_lights_punctual"))
    forEachOf(*lights, "lights", [&](Json& light) {
      scaleNumbers(light, {"range"}, scale);
      if (const auto extras = light.find("extras"); extras != light.end() && extras->is_object() &&
                                                    extras->contains("radius") &&
                                                    (*extras)["radius"].is_number())
        scaleNumbers(*extras, {"radius"}, scale);
    });
}

/// Adds a scene of all nodes that are not children, if there are no scenes.
void addMissingScene(Json& json) {
  if (json.contains("scenes") && !json["scenes"].empty()) return;
  std::set<std::size_t> children;
  for (const Json& node : json["nodes"])
    if (const auto list = node.find("children"); list != node.end())
      for (const Json& child : *list) children.insert(child.get<std::size_t>());
  Json roots = Json::array();
  for (std::size_t i = 0; i < json["nodes"].size(); ++i)
    if (!children.contains(i)) roots.push_back(i);
  json["scenes"] = Json::array({{{"nodes", roots}}});
  json["scene"] = 0;
}

}  // namespace

void scaleDocument(GltfDocument& document, double scale) {
  Json& json = document.json;
  scaleLengths(json, scale);
  if (!json.contains("nodes") || json["nodes"].empty()) return;
  addMissingScene(json);
  std::map<std::size_t, std::size_t> parents;
  for (Json& scene : json["scenes"]) {
    const auto roots = scene.find("nodes");
    if (roots == scene.end()) continue;
    for (Json& root : *roots) {
      const auto [parent, isNew] = parents.try_emplace(root.get<std::size_t>(), json["nodes"].size());
      if (isNew)
        json["nodes"].push_back(
            Json{{"scale", Json::array({scale, scale, scale})}, {"children", Json::array({parent->first})}});
      root = parent->second;
    }
  }
}

}  // namespace prelight
