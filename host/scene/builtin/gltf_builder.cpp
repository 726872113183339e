#include "scene/builtin/gltf_builder.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <span>

#include "images/image_encode.h"
#include "scene/gltf/extension_names.h"
#include "scene/gltf/gltf_embed.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;
constexpr int uint32 = 5125;
constexpr int float32 = 5126;

template <class Vector>
Json toJson(const Vector& v) {
  Json json = Json::array();
  for (int i = 0; i < v.length(); ++i) json.push_back(v[i]);
  return json;
}

Json plainMaterial(const std::string& name, const glm::vec3& color) {
  Json material;
  material["name"] = name;
  material["pbrMetallicRoughness"] = {
      {"baseColorFactor", toJson(glm::vec4(color, 1.0f))}, {"metallicFactor", 0}, {"roughnessFactor", 1}};
  return material;
}

template <class T>
int appendVectors(GltfDocument& document, const std::vector<T>& vectors, const char* type, int componentType,
                  std::size_t components) {
  const std::size_t count = vectors.size() * sizeof(T) / (4 * components);
  return appendAccessor(document, std::as_bytes(std::span(vectors)), type, componentType, count);
}

}  // namespace

GltfBuilder::GltfBuilder(const std::string& sceneName) {
  document_.path = sceneName + ".glb";
  Json& json = document_.json;
  json["asset"] = {{"version", "2.0"}, {"generator", "Prelight " PRELIGHT_VERSION}};
  json["extensionsUsed"] = Json::array();
  json["scene"] = 0;
  json["scenes"] = Json::array({{{"name", sceneName}, {"nodes", Json::array()}}});
  for (const char* part : {"nodes", "meshes", "materials", "cameras", "accessors", "bufferViews"}) {
    json[part] = Json::array();
  }
}

int GltfBuilder::addMaterial(Json material) {
  if (material.contains("extensions")) {
    for (const auto& extension : material["extensions"].items()) useExtension(extension.key());
  }
  Json& materials = document_.json["materials"];
  materials.push_back(std::move(material));
  return static_cast<int>(materials.size()) - 1;
}

int GltfBuilder::addDiffuse(const std::string& name, const glm::vec3& albedo) {
  Json material = plainMaterial(name, albedo);
  material["extensions"]["KHR_materials_specular"]["specularFactor"] = 0;
  return addMaterial(std::move(material));
}

int GltfBuilder::addBumpy(const std::string& name, const glm::vec3& albedo, const Image& normals,
                          float repeats) {
  Json& json = document_.json;
  const int view = appendBufferView(document_, encodePng(normals));
  json["images"].push_back({{"name", normals.name}, {"mimeType", "image/png"}, {"bufferView", view}});
  json["textures"].push_back({{"source", json["images"].size() - 1}});
  const int material = addDiffuse(name, albedo);
  Json texture = {{"index", json["textures"].size() - 1}};
  texture["extensions"]["KHR_texture_transform"]["scale"] = {repeats, repeats};
  useExtension("KHR_texture_transform");
  json["materials"][static_cast<std::size_t>(material)]["normalTexture"] = std::move(texture);
  return material;
}

int GltfBuilder::addEmitter(const std::string& name, const glm::vec3& radiance) {
  Json material = plainMaterial(name, glm::vec3(0.0f));
  const float strength = std::max({radiance.x, radiance.y, radiance.z});
  material["emissiveFactor"] = toJson(radiance / strength);
  material["extensions"]["KHR_materials_specular"]["specularFactor"] = 0;
  material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
  return addMaterial(std::move(material));
}

int GltfBuilder::addMirror(const std::string& name, const glm::vec3& color) {
  Json material = plainMaterial(name, color);
  material["pbrMetallicRoughness"]["metallicFactor"] = 1;
  material["pbrMetallicRoughness"]["roughnessFactor"] = 0;
  return addMaterial(std::move(material));
}

int GltfBuilder::addGlass(const std::string& name, float ior) {
  Json material = plainMaterial(name, glm::vec3(1.0f));
  material["pbrMetallicRoughness"]["roughnessFactor"] = 0;
  material["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 1;
  material["extensions"]["KHR_materials_volume"]["thicknessFactor"] = 1;
  material["extensions"]["KHR_materials_ior"]["ior"] = ior;
  return addMaterial(std::move(material));
}

int GltfBuilder::addObject(const std::string& name, const MeshShape& shape, int material,
                           const glm::vec3& translation, double yAngle) {
  const int positions = appendVectors(document_, shape.positions, "VEC3", float32, 3);
  glm::vec3 low = shape.positions.front();
  glm::vec3 high = low;
  for (const glm::vec3& p : shape.positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  document_.json["accessors"].back()["min"] = toJson(low);
  document_.json["accessors"].back()["max"] = toJson(high);
  const int normals = appendVectors(document_, shape.normals, "VEC3", float32, 3);
  const int indices = appendVectors(document_, shape.triangles, "SCALAR", uint32, 1);

  Json primitive;
  primitive["attributes"] = {{"POSITION", positions}, {"NORMAL", normals}};
  primitive["indices"] = indices;
  primitive["material"] = material;
  Json& meshes = document_.json["meshes"];
  Json mesh;
  mesh["name"] = name;
  mesh["primitives"] = Json::array({primitive});
  meshes.push_back(std::move(mesh));

  Json node;
  node["name"] = name;
  node["mesh"] = meshes.size() - 1;
  if (translation != glm::vec3(0.0f)) node["translation"] = toJson(translation);
  if (yAngle != 0.0) node["rotation"] = {0.0, std::sin(yAngle / 2.0), 0.0, std::cos(yAngle / 2.0)};
  addNode(std::move(node));
  return static_cast<int>(document_.json["nodes"].size()) - 1;
}

int GltfBuilder::addUnfolded(const std::string& name, const MeshShape& shape, int material,
                             const glm::vec3& translation, double yAngle) {
  const int node = addObject(name, shape, material, translation, yAngle);
  const int coords = appendVectors(document_, shape.texCoords, "VEC2", float32, 2);
  document_.json["meshes"].back()["primitives"][0]["attributes"]["TEXCOORD_0"] = coords;
  return node;
}

void GltfBuilder::animate(const std::string& animation, int node, AnimatedPath path,
                          const AnimationSampler& sampler) {
  Json& animations = document_.json["animations"];
  auto at = std::find_if(animations.begin(), animations.end(),
                         [&](const Json& json) { return json["name"] == animation; });
  if (at == animations.end()) {
    animations.push_back({{"name", animation}, {"channels", Json::array()}, {"samplers", Json::array()}});
    at = std::prev(animations.end());
  }
  Json json;
  json["input"] = appendVectors(document_, sampler.times, "SCALAR", float32, 1);
  document_.json["accessors"].back()["min"] = {sampler.times.front()};
  document_.json["accessors"].back()["max"] = {sampler.times.back()};
  if (path == AnimatedPath::Rotation) {
    json["output"] = appendVectors(document_, sampler.values, "VEC4", float32, 4);
  } else {
    const std::vector<glm::vec3> values(sampler.values.begin(), sampler.values.end());
    json["output"] = appendVectors(document_, values, "VEC3", float32, 3);
  }
  constexpr const char* interpolations[] = {"LINEAR", "STEP", "CUBICSPLINE"};
  constexpr const char* paths[] = {"translation", "rotation", "scale"};
  json["interpolation"] = interpolations[static_cast<int>(sampler.interpolation)];
  (*at)["channels"].push_back({{"sampler", (*at)["samplers"].size()},
                               {"target", {{"node", node}, {"path", paths[static_cast<int>(path)]}}}});
  (*at)["samplers"].push_back(std::move(json));
}

void GltfBuilder::addPointLight(const std::string& name, const glm::vec3& position, const glm::vec3& color,
                                double intensity) {
  useExtension("KHR_lights_punctual");
  Json& lights = document_.json["extensions"]["KHR_lights_punctual"]["lights"];
  lights.push_back({{"name", name}, {"type", "point"}, {"color", toJson(color)}, {"intensity", intensity}});
  Json node;
  node["name"] = name;
  node["translation"] = toJson(position);
  node["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
  addNode(std::move(node));
}

void GltfBuilder::addCamera(const std::string& name, const glm::dvec3& eye, const glm::dvec3& target,
                            double yFov, double aspect) {
  Json& cameras = document_.json["cameras"];
  Json camera;
  camera["name"] = name;
  camera["type"] = "perspective";
  camera["perspective"] = {{"aspectRatio", aspect}, {"yfov", yFov}, {"znear", 0.01}, {"zfar", 100.0}};
  cameras.push_back(std::move(camera));
  const glm::dquat turn = glm::quatLookAt(glm::normalize(target - eye), glm::dvec3(0.0, 1.0, 0.0));
  Json node;
  node["name"] = name;
  node["camera"] = cameras.size() - 1;
  node["translation"] = toJson(eye);
  node["rotation"] = {turn.x, turn.y, turn.z, turn.w};
  addNode(std::move(node));
}

void GltfBuilder::addNode(Json node) {
  Json& nodes = document_.json["nodes"];
  document_.json["scenes"][0]["nodes"].push_back(nodes.size());
  nodes.push_back(std::move(node));
}

void GltfBuilder::useExtension(const std::string& name) { useExtensionName(document_.json, name); }

}  // namespace prelight
