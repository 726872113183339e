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

}  // namespace

std::vector<glm::vec4> texCoords(const CompiledScene& compiled) {
  std::vector<glm::vec4> coords;
  coords.reserve(compiled.texCoords.size());
  for (std::size_t i = 0; i < compiled.texCoords.size(); ++i)
    coords.emplace_back(compiled.texCoords[i],
                        i < compiled.texCoords1.size() ? compiled.texCoords1[i] : glm::vec2(0.0f));
  return coords;
}

glm::vec2 texturePlace(const TextureRef& use, const glm::vec4& coords) {
  const glm::vec2 at = use.texCoord == 1 ? glm::vec2(coords.z, coords.w) : glm::vec2(coords.x, coords.y);
  return glm::vec2(use.transform * glm::vec3(at, 1.0f));
}

std::vector<glm::vec4> tangents(const Scene& scene, const CompiledScene& compiled) {
  std::vector<glm::vec4> result(compiled.vertexCount(), glm::vec4(0.0f));
  const std::map<int, const MeshNode*> nodes = nodesByNumber(scene);
  for (const PrimitiveRange& range : compiled.primitives) {
    const Primitive* primitive = findPrimitive(scene, nodes, range);
    if (primitive == nullptr) continue;
    const auto& transforms = nodes.at(range.node)->transforms;
    const auto instance = static_cast<std::size_t>(range.instance);
    const glm::dmat3 world(instance < transforms.size() ? transforms[instance] : glm::dmat4(1.0));
    // A mirroring transform turns the bitangent around, which the cross product would not.
    const float mirror = glm::determinant(world) < 0.0 ? -1.0f : 1.0f;
    for (std::uint32_t i = 0; i < range.vertexCount && i < primitive->tangents.size(); ++i) {
      const glm::vec4& tangent = primitive->tangents[i];
      result[range.firstVertex + i] = glm::vec4(glm::vec3(world * glm::dvec3(tangent)), mirror * tangent.w);
    }
  }
  return result;
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
