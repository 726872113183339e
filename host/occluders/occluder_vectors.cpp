#include "occluders/occluder_vectors.h"

#include <algorithm>
#include <limits>

#include "scene/lobes.h"

namespace prelight {

namespace {

constexpr float roughestShine = 0.5f;

}  // namespace

bool isShiny(const CompiledMaterial& material) {
  const bool reflects = material.metallic > 0.0f || (material.specular > 0.0f && material.ior != 1.0f);
  return !material.unlit && reflects && material.roughness <= roughestShine;
}

bool hasShine(const CompiledScene& scene) { return anyTriangle(scene, isShiny); }

bool hasGlass(const CompiledScene& scene) { return anyTriangle(scene, isGlass); }

std::vector<OccluderVector> neededVectors(const CompiledScene& scene) {
  std::vector<OccluderVector> vectors = {OccluderVector::Position, OccluderVector::Occlusion,
                                         OccluderVector::DiffuseNormal, OccluderVector::DiffuseColor};
  if (hasGlass(scene)) vectors.insert(vectors.end(), {OccluderVector::Caustic, OccluderVector::Transmissive});
  if (hasShine(scene))
    vectors.insert(vectors.end(), {OccluderVector::SpecularNormal, OccluderVector::SpecularColor});
  std::sort(vectors.begin(), vectors.end());
  return vectors;
}

double freeReach(const CompiledScene& scene) {
  const bool lamps =
      anyTriangle(scene, [](const CompiledMaterial& m) { return glm::length(m.emission) > 0.0f; });
  const bool lights = std::any_of(scene.lights.begin(), scene.lights.end(), [&](const Light& light) {
    const glm::vec3 place(light.position - scene.origin);
    return light.type != LightType::Directional && glm::all(glm::lessThanEqual(scene.boundsMin, place)) &&
           glm::all(glm::lessThanEqual(place, scene.boundsMax));
  });
  if (!lamps && !lights) return std::numeric_limits<double>::infinity();
  return 0.25 * glm::length(glm::dvec3(scene.boundsMax) - glm::dvec3(scene.boundsMin));
}

}  // namespace prelight
