#include "viewer/scene/surface.h"

#include <iterator>
#include <limits>
#include <map>

#include "base/colour.h"
#include "gpu/surface_upload.h"
#include "photon/photon_sources.h"
#include "scene/lobes.h"
#include "viewer/scene/tex_coords.h"

namespace prelight::viewer {
namespace {

/// The first triangle of every primitive and its node, in order: blended batches and those that show their
/// surroundings end where a primitive does.
std::map<std::uint32_t, int> primitiveStarts(const CompiledScene& compiled) {
  std::map<std::uint32_t, int> starts;
  for (const PrimitiveRange& range : compiled.primitives)
    if (range.triangleCount > 0) starts[range.firstTriangle] = range.node;
  return starts;
}

constexpr float metallic = 0.5f;  ///< surfaces with more of it reflect little diffusely

bool mirrors(const CompiledMaterial& material) {
  return makesCaustics(material) || isGlass(material) || (!material.unlit && material.metallic >= metallic);
}

constexpr float glossyRoughness = 0.5f;  ///< layers of more of it show a mean of what lies around

bool reflectsAround(const CompiledMaterial& m) {
  const bool layer = reflectsSpecularly(m) && (m.roughness < glossyRoughness || m.surfaceTexture.image >= 0);
  return mirrors(m) || layer || m.clearcoat.factor > 0.0f;
}

/// Share of the light that passes a material along its normal, textures apart; 0 of what is no pane.
float straightShare(const CompiledMaterial& m) {
  if (!isPane(m)) return 0.0f;
  const float root = (m.ior - 1.0f) / (m.ior + 1.0f), face = root * root;
  return (1.0f - 2.0f * face / (1.0f + face)) * m.transmission * (1.0f - m.metallic) *
         static_cast<float>(luminance(m.baseColor));
}

/// White where the scene has no such image.
SurfaceTexture textureOf(const Scene& scene, const TextureRef& use, bool srgb) {
  if (use.image < 0 || static_cast<std::size_t>(use.image) >= scene.images.size()) return {};
  return {nullptr, use, srgb};
}

SurfaceTexture textureOf(const RenderInputs& inputs, const Material& m, TextureSlot slot) {
  const Scene& scene = inputs.scene;
  switch (slot) {
    case TextureSlot::BaseColor:
      return textureOf(scene, m.baseColorTexture, true);
    case TextureSlot::MetallicRoughness:
      return textureOf(scene, m.metallicRoughnessTexture, false);
    case TextureSlot::Emissive:
      return textureOf(scene, m.emissiveTexture, true);
    case TextureSlot::Normal:
      return textureOf(scene, inputs.normalTextures ? m.normalTexture : TextureRef{}, false);
    case TextureSlot::Transmission:
      return textureOf(scene, m.transmissionTexture, false);
    case TextureSlot::Specular:
      return textureOf(scene, m.specularTexture, false);
    case TextureSlot::SpecularColor:
      return textureOf(scene, m.specularColorTexture, true);
    case TextureSlot::Coat:
      return textureOf(scene, m.clearcoat.texture, false);
    case TextureSlot::CoatRoughness:
      return textureOf(scene, m.clearcoat.roughnessTexture, false);
    case TextureSlot::CoatNormal:
      return textureOf(scene, inputs.normalTextures ? m.clearcoat.normalTexture : TextureRef{}, false);
    case TextureSlot::SheenColor:
      return textureOf(scene, m.sheen.colorTexture, true);
    case TextureSlot::SheenRoughness:
      return textureOf(scene, m.sheen.roughnessTexture, false);
    case TextureSlot::Anisotropy:
      return textureOf(scene, m.anisotropy.texture, false);
    case TextureSlot::Film:
      return textureOf(scene, m.iridescence.texture, false);
    case TextureSlot::FilmThickness:
      return textureOf(scene, m.iridescence.thicknessTexture, false);
  }
  return {};
}

}  // namespace

std::vector<int> measuredNumbers(const CompiledScene& scene) {
  std::map<const MeasuredBrdf*, int> numbers;
  std::vector<int> result;
  for (const CompiledMaterial& m : scene.materials)
    result.push_back(
        hasMeasuredLobe(m)
            ? numbers.try_emplace(m.measured.get(), static_cast<int>(numbers.size())).first->second
            : -1);
  return result;
}

std::vector<Surface> surfacesOf(const RenderInputs& inputs) {
  const std::vector<int> measured = measuredNumbers(inputs.compiled);
  std::vector<Surface> surfaces;
  for (std::size_t i = 0; i < inputs.compiled.materials.size(); ++i) {
    const CompiledMaterial& compiled = inputs.compiled.materials[i];
    Surface surface;
    surface.material = materialAt(inputs.scene, inputs.compiled, i);
    surface.showsSurroundings = mirrors(compiled);
    surface.showsNarrowLobes = makesCaustics(compiled);
    surface.reflectsAround = reflectsAround(compiled);
    surface.absorption = compiled.absorption;
    surface.measured = measured[i];
    surface.passes = straightShare(compiled);
    surface.translucency = glm::vec4(compiled.diffuseTransmission, compiled.meanTranslucency);
    for (std::size_t slot = 0; slot < surfaceTextures; ++slot)
      surface.textures[slot] = textureOf(inputs, surface.material, static_cast<TextureSlot>(slot));
    surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

SceneAlbedos surfaceAlbedos(const CompiledScene& compiled, std::vector<Surface>& surfaces) {
  const std::vector<bool> used = usedMaterials(compiled);
  bool lookedUp = false;
  for (std::size_t i = 0; i < used.size(); ++i) {
    const CompiledMaterial& m = compiled.materials[i];
    lookedUp = lookedUp || (used[i] && (reflectsSpecularly(m) || hasLayers(m) || isRoughGlass(m)));
  }
  if (!lookedUp) return {};
  SceneAlbedos albedos = makeSceneAlbedos(compiled, used);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    surfaces[i].filmTable = albedos.filmTables[i];
    surfaces[i].glassTable = albedos.glassTables[i];
  }
  return albedos;
}

glm::vec3 centerOf(const CompiledScene& compiled, const Batch& batch) {
  glm::vec3 lower(std::numeric_limits<float>::max());
  glm::vec3 upper(std::numeric_limits<float>::lowest());
  for (std::uint32_t t = 0; t < batch.triangleCount; ++t) {
    const glm::uvec3 corners = compiled.triangles[batch.firstTriangle + t];
    for (int k = 0; k < 3; ++k) {
      lower = glm::min(lower, compiled.positions[corners[k]]);
      upper = glm::max(upper, compiled.positions[corners[k]]);
    }
  }
  return 0.5f * (lower + upper);
}

std::vector<Batch> batchesOf(const CompiledScene& compiled, const std::vector<Surface>& surfaces) {
  std::vector<Batch> batches;
  const std::map<std::uint32_t, int> starts = primitiveStarts(compiled);
  for (std::uint32_t t = 0; t < compiled.triangleCount(); ++t) {
    const std::uint32_t surface = compiled.triangleMaterials[t];
    const bool goesOn =
        !batches.empty() && batches.back().surface == surface &&
        !((surfaces[surface].isBlended() || surfaces[surface].reflectsAround) && starts.contains(t));
    if (goesOn) {
      ++batches.back().triangleCount;
    } else {
      batches.push_back({surface, t, 1, {}});
      const auto primitive = starts.upper_bound(t);
      if (surfaces[surface].reflectsAround && primitive != starts.begin()) {
        const int node = std::prev(primitive)->second;
        batches.back().reflectingNode = node;
        if (surfaces[surface].showsSurroundings) batches.back().node = node;
      }
    }
  }
  for (Batch& batch : batches) batch.center = centerOf(compiled, batch);
  return batches;
}

std::vector<glm::vec4> geometricNormals(const CompiledScene& compiled) {
  std::vector<glm::vec4> normals;
  normals.reserve(compiled.triangles.size());
  for (std::uint32_t t = 0; t < compiled.triangleCount(); ++t) {
    const glm::dvec3 normal = geometricNormal(compiled, t);
    const double length = glm::length(normal);
    const glm::dvec3 unit = length > 0.0 ? normal / length : glm::dvec3(0.0, 1.0, 0.0);
    const bool flat = t < compiled.triangleFlat.size() && compiled.triangleFlat[t] != 0;
    normals.emplace_back(glm::vec3(unit), flat ? 1.0f : 0.0f);
  }
  return normals;
}

}  // namespace prelight::viewer
