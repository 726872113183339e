#include "scene/light_sources.h"

#include <algorithm>

namespace prelight {

const Environment* shiningSky(const Environment* sky) {
  if (sky == nullptr) return nullptr;
  return std::any_of(sky->radiance.begin(), sky->radiance.end(), shines) ? sky : nullptr;
}

bool hasLights(const CompiledScene& scene) {
  return std::any_of(scene.lights.begin(), scene.lights.end(),
                     [](const Light& light) { return shines(light.intensity); }) ||
         std::any_of(scene.triangleMaterials.begin(), scene.triangleMaterials.end(),
                     [&](std::uint32_t m) { return shines(scene.materials[m].emission); });
}

bool onlyGlows(const CompiledScene& scene) {
  constexpr double mostMean = 0.1;  // W/(m2 sr) over the whole surface
  double light = 0.0, area = 0.0;
  for (const Light& lamp : scene.lights)
    if (shines(lamp.intensity)) return false;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) {
    const CompiledMaterial& material = scene.materials[scene.triangleMaterials[t]];
    const double size = glm::length(geometricNormal(scene, t));
    area += size;
    if (!shines(material.emission)) continue;
    const glm::vec3& most = material.emissionFactor;
    if (material.unlit || material.emissionTexture.image < 0 || std::max({most.x, most.y, most.z}) > 1.0f)
      return false;
    light += size * double(std::max({material.emission.x, material.emission.y, material.emission.z}));
  }
  return light > 0.0 && light <= mostMean * area;
}

bool scattersDiffusely(const CompiledScene& scene) {
  return scene.hasDiffuseTransmission() ||
         std::any_of(scene.triangleMaterials.begin(), scene.triangleMaterials.end(),
                     [&](std::uint32_t m) { return shines(scene.materials[m].albedo); });
}

}  // namespace prelight
