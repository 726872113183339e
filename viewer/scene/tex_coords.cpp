#include "viewer/scene/tex_coords.h"

namespace prelight::viewer {

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

Material materialAt(const Scene& scene, const CompiledScene& compiled, std::size_t index) {
  const CompiledMaterial& lambert = compiled.materials[index];
  const int source = lambert.source;
  Material material;
  if (source >= 0 && static_cast<std::size_t>(source) < scene.materials.size()) {
    material = scene.materials[static_cast<std::size_t>(source)];
    material.doubleSided = lambert.doubleSided;
    return material;
  }
  if (lambert.albedo == glm::vec3(0.0f) && lambert.emission == glm::vec3(0.0f)) return material;
  material.baseColor = glm::vec4(lambert.albedo, 1.0f);
  material.metallic = 0.0f;
  material.specular = 0.0f;
  material.emission = lambert.emission;
  material.doubleSided = lambert.doubleSided;
  return material;
}

}  // namespace prelight::viewer
