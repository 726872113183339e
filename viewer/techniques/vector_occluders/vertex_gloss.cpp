#include "viewer/techniques/vector_occluders/vertex_gloss.h"

#include <algorithm>
#include <cmath>

#include "scene/surface/image_lookup.h"
#include "viewer/scene/tex_coords.h"

namespace prelight::viewer {
namespace {

glm::vec4 lookUpTexel(const Scene& scene, const TextureRef& texture, const glm::vec4& coords) {
  if (texture.image < 0 || static_cast<std::size_t>(texture.image) >= scene.images.size())
    return glm::vec4(1.0f);
  return sampleImage(scene.images[static_cast<std::size_t>(texture.image)], texture,
                     texturePlace(texture, coords));
}

glm::vec3 decodeSrgb(const glm::vec3& v) {
  return glm::mix(v / 12.92f, glm::pow((v + 0.055f) / 1.055f, glm::vec3(2.4f)),
                  glm::greaterThan(v, glm::vec3(0.04045f)));
}

/// readMaterial() of shaders/material.glsl.
glm::vec4 glossOf(const Scene& scene, const Material& m, const glm::vec4& coords,
                  const glm::vec4& vertexColor, bool all) {
  const glm::vec3 base = glm::vec3(m.baseColor) * decodeSrgb(lookUpTexel(scene, m.baseColorTexture, coords)) *
                         glm::vec3(vertexColor);
  const glm::vec4 factors = lookUpTexel(scene, m.metallicRoughnessTexture, coords);
  const float metallic = m.metallic * factors.b, roughness = m.roughness * factors.g;
  const float ratio = m.ior > 0.0f ? (m.ior - 1.0f) / (m.ior + 1.0f) : 1.0f;
  const glm::vec3 color = m.specularColor * decodeSrgb(lookUpTexel(scene, m.specularColorTexture, coords));
  const float specular = m.specular * lookUpTexel(scene, m.specularTexture, coords).a;
  const glm::vec3 dielectric = glm::min(ratio * ratio * color, glm::vec3(1.0f)) * specular;
  const float glass = m.transmission * lookUpTexel(scene, m.transmissionTexture, coords).r;
  const float weight = all ? 1.0f : std::max(metallic, glass * (1.0f - metallic));
  if (m.unlit) return {0.0f, 0.0f, 0.0f, 1.0f};
  return {weight * glm::mix(dielectric, base, metallic), std::clamp(roughness, 0.0f, 1.0f)};
}

}  // namespace

std::vector<glm::vec4> vertexGloss(const RenderInputs& inputs, bool all) {
  const CompiledScene& compiled = inputs.compiled;
  const std::vector<glm::vec4> coords = texCoords(compiled);
  std::vector<Material> materials;
  for (std::size_t i = 0; i < compiled.materials.size(); ++i)
    materials.push_back(materialAt(inputs.scene, compiled, i));
  std::vector<glm::vec4> result(compiled.vertexCount(), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
  for (std::size_t t = 0; t < compiled.triangles.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t v = compiled.triangles[t][corner];
      const glm::vec4 color = compiled.hasVertexColors() ? compiled.colors[v] : glm::vec4(1.0f);
      result[v] = glossOf(inputs.scene, materials[compiled.triangleMaterials[t]],
                          coords.empty() ? glm::vec4(0.0f) : coords[v], color, all);
    }
  }
  return result;
}

}  // namespace prelight::viewer
