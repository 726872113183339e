#include "viewer/tex_coords.h"

#include <map>

namespace prelight::viewer {
namespace {

std::map<int, const MeshNode*> nodesByNumber(const Scene& scene) {
  std::map<int, const MeshNode*> nodes;
  for (const MeshNode& node : scene.meshNodes) nodes[node.node] = &node;
  return nodes;
}

const Primitive* findPrimitive(const Scene& scene, const std::map<int, const MeshNode*>& nodes,
                               const PrimitiveRange& range) {
  const auto node = nodes.find(range.node);
  if (node == nodes.end()) return nullptr;
  const auto& primitives = scene.meshes[node->second->mesh].primitives;
  if (range.primitive < 0 || static_cast<std::size_t>(range.primitive) >= primitives.size()) return nullptr;
  const Primitive& primitive = primitives[range.primitive];
  return primitive.positions.size() == range.vertexCount ? &primitive : nullptr;
}

glm::vec2 lookUpCoords(const Primitive& primitive, const TextureRef& use, std::size_t vertex) {
  const auto& coords = use.texCoord == 1 ? primitive.texCoords1 : primitive.texCoords0;
  return vertex < coords.size() ? glm::vec2(use.transform * glm::vec3(coords[vertex], 1.0f))
                                : glm::vec2(0.0f);
}

}  // namespace

TexCoords texCoords(const Scene& scene, const CompiledScene& compiled) {
  TexCoords result;
  for (const glm::vec2& uv : compiled.texCoords) {
    result.baseColorAndMetallicRoughness.emplace_back(uv, uv);
    result.emissive.push_back(uv);
  }
  result.baseColorAndMetallicRoughness.resize(compiled.vertexCount(), glm::vec4(0.0f));
  result.emissive.resize(compiled.vertexCount(), glm::vec2(0.0f));

  const std::map<int, const MeshNode*> nodes = nodesByNumber(scene);
  for (const PrimitiveRange& range : compiled.primitives) {
    const Primitive* primitive = findPrimitive(scene, nodes, range);
    if (primitive == nullptr) continue;
    const Material& material = scene.materialOf(*primitive);
    for (std::uint32_t i = 0; i < range.vertexCount; ++i) {
      result.baseColorAndMetallicRoughness[range.firstVertex + i] =
          glm::vec4(lookUpCoords(*primitive, material.baseColorTexture, i),
                    lookUpCoords(*primitive, material.metallicRoughnessTexture, i));
      result.emissive[range.firstVertex + i] = lookUpCoords(*primitive, material.emissiveTexture, i);
    }
  }
  return result;
}

NormalPlaces normalPlaces(const Scene& scene, const CompiledScene& compiled) {
  NormalPlaces places{std::vector<glm::vec2>(compiled.vertexCount(), glm::vec2(0.0f)),
                      std::vector<glm::vec4>(compiled.vertexCount(), glm::vec4(0.0f))};
  const std::map<int, const MeshNode*> nodes = nodesByNumber(scene);
  for (const PrimitiveRange& range : compiled.primitives) {
    const Primitive* primitive = findPrimitive(scene, nodes, range);
    if (primitive == nullptr) continue;
    const TextureRef& use = scene.materialOf(*primitive).normalTexture;
    const auto& transforms = nodes.at(range.node)->transforms;
    const auto instance = static_cast<std::size_t>(range.instance);
    const glm::dmat3 world(instance < transforms.size() ? transforms[instance] : glm::dmat4(1.0));
    // A mirroring transform turns the bitangent around, which the cross product would not.
    const float mirror = glm::determinant(world) < 0.0 ? -1.0f : 1.0f;
    for (std::uint32_t i = 0; i < range.vertexCount; ++i) {
      places.coords[range.firstVertex + i] = lookUpCoords(*primitive, use, i);
      if (i >= primitive->tangents.size()) continue;
      const glm::vec4& tangent = primitive->tangents[i];
      places.tangents[range.firstVertex + i] =
          glm::vec4(glm::vec3(world * glm::dvec3(tangent)), mirror * tangent.w);
    }
  }
  return places;
}

Material materialAt(const Scene& scene, const CompiledScene& compiled, std::size_t index) {
  if (index < scene.materials.size()) return scene.materials[index];
  const CompiledMaterial& lambert = compiled.materials[index];
  Material material;
  if (lambert.albedo == glm::vec3(0.0f) && lambert.emission == glm::vec3(0.0f)) return material;
  material.baseColor = glm::vec4(lambert.albedo, 1.0f);
  material.metallic = 0.0f;
  material.specular = 0.0f;
  material.emission = lambert.emission;
  material.doubleSided = lambert.doubleSided;
  return material;
}

}  // namespace prelight::viewer
