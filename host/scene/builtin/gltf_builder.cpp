#include "scene/builtin/gltf_builder.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <span>

#include "images/picture_codecs.h"
#include "scene/gltf/gltf_document.h"
#include "scene/gltf/gltf_embed.h"

namespace prelight {

namespace {

using Json = nlohmann::ordered_json;
constexpr int uint32Type = 5125;
constexpr int float32Type = 5126;

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
int appendVectors(GltfDocument& document, std::span<const T> vectors, const char* type, int componentType,
                  std::size_t components) {
  const std::size_t count = vectors.size() * sizeof(T) / (4 * components);
  return appendAccessor(document, std::as_bytes(vectors), type, componentType, count);
}

template <class T>
int appendVectors(GltfDocument& document, const std::vector<T>& vectors, const char* type, int componentType,
                  std::size_t components) {
  return appendVectors(document, std::span<const T>(vectors), type, componentType, components);
}

Json toJson(const glm::dmat4& matrix) {
  Json json = Json::array();
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 4; ++row) json.push_back(matrix[column][row]);
  return json;
}

/// Returns the rotation that turns -Z, along which lights and cameras look, to a unit direction.
Json turnTo(const glm::dvec3& direction) {
  const glm::dvec3 up = std::abs(direction.y) < 0.999 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, 1.0);
  const glm::dquat turn = glm::quatLookAt(direction, up);
  return {turn.x, turn.y, turn.z, turn.w};
}

/// Returns the largest channel: glTF stores some colours as a strength and a colour of at most 1.
float strengthOf(const glm::vec3& color) { return std::max({color.x, color.y, color.z}); }

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
  const int normalTexture = addTexture(normals);
  const int material = addDiffuse(name, albedo);
  Json texture = {{"index", normalTexture}};
  texture["extensions"]["KHR_texture_transform"]["scale"] = {repeats, repeats};
  useExtension("KHR_texture_transform");
  document_.json["materials"][static_cast<std::size_t>(material)]["normalTexture"] = std::move(texture);
  return material;
}

int GltfBuilder::addEmitter(const std::string& name, const glm::vec3& radiance) {
  Json material = plainMaterial(name, glm::vec3(0.0f));
  const float strength = strengthOf(radiance);
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

int GltfBuilder::addPlain(const PlainMaterial& plain) {
  Json material = plainMaterial(plain.name, glm::vec3(plain.baseColor));
  Json& surface = material["pbrMetallicRoughness"];
  surface["baseColorFactor"] = toJson(plain.baseColor);
  surface["metallicFactor"] = plain.metallic;
  surface["roughnessFactor"] = plain.roughness;
  if (plain.baseColor.a < 1.0f) material["alphaMode"] = "BLEND";
  if (plain.doubleSided) material["doubleSided"] = true;
  const float strength = strengthOf(plain.emission);
  if (strength > 0.0f) material["emissiveFactor"] = toJson(plain.emission / strength);
  Json& extensions = material["extensions"];  // taken last, because adding a further member would move it
  extensions["KHR_materials_specular"]["specularFactor"] = plain.specular;
  extensions["KHR_materials_ior"]["ior"] = plain.ior;
  if (strength > 0.0f) extensions["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
  if (plain.transmission > 0.0f)
    extensions["KHR_materials_transmission"]["transmissionFactor"] = plain.transmission;
  if (plain.solid) extensions["KHR_materials_volume"]["thicknessFactor"] = 1;
  return addMaterial(std::move(material));
}

int GltfBuilder::addTexture(const Image& image) {
  Json& json = document_.json;
  const int view = appendBufferView(document_, encodePng(image));
  json["images"].push_back({{"name", image.name}, {"mimeType", "image/png"}, {"bufferView", view}});
  json["textures"].push_back({{"source", json["images"].size() - 1}});
  return static_cast<int>(json["textures"].size()) - 1;
}

MapIndices GltfBuilder::addMaps(const Image& albedo, const Image& roughness, const Image& normals) {
  return {addTexture(albedo), addTexture(roughness), addTexture(normals)};
}

int GltfBuilder::addMapped(const PlainMaterial& plain, const MapIndices& maps) {
  const int index = addPlain(plain);
  Json& material = document_.json["materials"][static_cast<std::size_t>(index)];
  Json& surface = material["pbrMetallicRoughness"];
  if (maps.albedo >= 0) surface["baseColorTexture"] = {{"index", maps.albedo}};
  if (maps.roughness >= 0) surface["metallicRoughnessTexture"] = {{"index", maps.roughness}};
  if (maps.normals >= 0) material["normalTexture"] = {{"index", maps.normals}};
  return index;
}

void GltfBuilder::addSheen(int material, const glm::vec3& color, float roughness) {
  useExtension("KHR_materials_sheen");
  document_.json["materials"][static_cast<std::size_t>(material)]["extensions"]["KHR_materials_sheen"] = {
      {"sheenColorFactor", toJson(color)}, {"sheenRoughnessFactor", roughness}};
}

int GltfBuilder::addPositions(std::span<const glm::vec3> points) {
  const int positions = appendVectors(document_, points, "VEC3", float32Type, 3);
  glm::vec3 low = points.front();
  glm::vec3 high = low;
  for (const glm::vec3& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  document_.json["accessors"].back()["min"] = toJson(low);
  document_.json["accessors"].back()["max"] = toJson(high);
  return positions;
}

/// Adds a mesh named like its node.
void GltfBuilder::addMeshNode(Json primitive, Json node) {
  Json& meshes = document_.json["meshes"];
  Json mesh;
  mesh["name"] = node["name"];
  mesh["primitives"] = Json::array({std::move(primitive)});
  node["mesh"] = meshes.size();
  meshes.push_back(std::move(mesh));
  addNode(std::move(node));
}

void GltfBuilder::addMesh(const MeshArrays& mesh) {
  Json primitive;
  Json& attributes = primitive["attributes"];
  attributes["POSITION"] = addPositions(mesh.positions);
  if (!mesh.normals.empty())
    attributes["NORMAL"] = appendVectors(document_, mesh.normals, "VEC3", float32Type, 3);
  if (!mesh.texCoords.empty())
    attributes["TEXCOORD_0"] = appendVectors(document_, mesh.texCoords, "VEC2", float32Type, 2);
  if (!mesh.texCoords1.empty())
    attributes["TEXCOORD_1"] = appendVectors(document_, mesh.texCoords1, "VEC2", float32Type, 2);
  if (!mesh.colors.empty())
    attributes["COLOR_0"] = appendVectors(document_, mesh.colors, "VEC4", float32Type, 4);
  primitive["indices"] = appendVectors(document_, mesh.triangles, "SCALAR", uint32Type, 1);
  if (mesh.material >= 0) primitive["material"] = mesh.material;
  Json node;
  node["name"] = mesh.name;
  if (mesh.toWorld != glm::dmat4(1.0)) node["matrix"] = toJson(mesh.toWorld);
  addMeshNode(std::move(primitive), std::move(node));
}

void GltfBuilder::addLight(const Light& light) {
  constexpr const char* types[] = {"directional", "point", "spot"};
  useExtension("KHR_lights_punctual");
  Json& lights = document_.json["extensions"]["KHR_lights_punctual"]["lights"];
  const float strength = strengthOf(light.intensity);
  Json json = {{"name", light.name}, {"type", types[static_cast<int>(light.type)]}, {"intensity", strength}};
  if (strength > 0.0f) json["color"] = toJson(light.intensity / strength);
  if (light.range > 0.0f) json["range"] = light.range;
  if (light.type == LightType::Spot)
    json["spot"] = {{"innerConeAngle", light.innerConeAngle}, {"outerConeAngle", light.outerConeAngle}};
  if (light.radius > 0.0f && light.type == LightType::Directional)
    json["extras"]["angle"] = 2.0f * light.radius;
  if (light.radius > 0.0f && light.type != LightType::Directional) json["extras"]["radius"] = light.radius;
  lights.push_back(std::move(json));
  Json node;
  node["name"] = light.name;
  node["translation"] = toJson(light.position);
  node["rotation"] = turnTo(light.direction);
  node["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
  addNode(std::move(node));
}

void GltfBuilder::addCamera(const Camera& camera) {
  Json json;
  json["name"] = camera.name;
  json["type"] = camera.perspective ? "perspective" : "orthographic";
  if (camera.perspective) {
    json["perspective"] = {{"yfov", camera.yFov}, {"znear", camera.zNear}};
    if (camera.aspect > 0.0) json["perspective"]["aspectRatio"] = camera.aspect;
    if (camera.zFar > 0.0) json["perspective"]["zfar"] = camera.zFar;
  } else {
    json["orthographic"] = {
        {"xmag", camera.xMag}, {"ymag", camera.yMag}, {"znear", camera.zNear}, {"zfar", camera.zFar}};
  }
  Json& cameras = document_.json["cameras"];
  cameras.push_back(std::move(json));
  Json node;
  node["name"] = camera.name;
  node["camera"] = cameras.size() - 1;
  node["matrix"] = toJson(camera.world);
  addNode(std::move(node));
}

int GltfBuilder::addObject(const std::string& name, const MeshShape& shape, int material,
                           const glm::vec3& translation, double yAngle) {
  const int positions = addPositions(shape.positions);
  const int normals = appendVectors(document_, shape.normals, "VEC3", float32Type, 3);
  const int indices = appendVectors(document_, shape.triangles, "SCALAR", uint32Type, 1);

  Json primitive;
  primitive["attributes"] = {{"POSITION", positions}, {"NORMAL", normals}};
  primitive["indices"] = indices;
  primitive["material"] = material;
  Json node;
  node["name"] = name;
  node["mesh"] = nullptr;  // reserves its position among the members
  if (translation != glm::vec3(0.0f)) node["translation"] = toJson(translation);
  if (yAngle != 0.0) node["rotation"] = {0.0, std::sin(yAngle / 2.0), 0.0, std::cos(yAngle / 2.0)};
  addMeshNode(std::move(primitive), std::move(node));
  return static_cast<int>(document_.json["nodes"].size()) - 1;
}

int GltfBuilder::addUnfolded(const std::string& name, const MeshShape& shape, int material,
                             const glm::vec3& translation, double yAngle) {
  const int node = addObject(name, shape, material, translation, yAngle);
  const int coords = appendVectors(document_, shape.texCoords, "VEC2", float32Type, 2);
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
  json["input"] = appendVectors(document_, sampler.times, "SCALAR", float32Type, 1);
  document_.json["accessors"].back()["min"] = {sampler.times.front()};
  document_.json["accessors"].back()["max"] = {sampler.times.back()};
  if (path == AnimatedPath::Rotation) {
    json["output"] = appendVectors(document_, sampler.values, "VEC4", float32Type, 4);
  } else {
    const std::vector<glm::vec3> values(sampler.values.begin(), sampler.values.end());
    json["output"] = appendVectors(document_, values, "VEC3", float32Type, 3);
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
  Json node;
  node["name"] = name;
  node["camera"] = cameras.size() - 1;
  node["translation"] = toJson(eye);
  node["rotation"] = turnTo(glm::normalize(target - eye));
  addNode(std::move(node));
}

void GltfBuilder::addNode(Json node) {
  Json& nodes = document_.json["nodes"];
  document_.json["scenes"][0]["nodes"].push_back(nodes.size());
  nodes.push_back(std::move(node));
}

void GltfBuilder::useExtension(const std::string& name) { useExtensionName(document_.json, name); }

}  // namespace prelight
