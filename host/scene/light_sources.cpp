#include "scene/light_sources.h"

#include <algorithm>

#include "scene/emitters.h"

namespace prelight {

const Environment* shiningSky(const Environment* sky) {
  if (sky == nullptr) return nullptr;
  return std::any_of(sky->radiance.begin(), sky->radiance.end(), shines) ? sky : nullptr;
}

bool hasEmitters(const CompiledScene& scene) {
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    if (emits(scene, t)) return true;
  return false;
}

bool hasLights(const CompiledScene& scene) {
  return std::any_of(scene.lights.begin(), scene.lights.end(),
                     [](const Light& light) { return shines(light.intensity); }) ||
         hasEmitters(scene);
}

bool scattersDiffusely(const CompiledScene& scene) {
  return scene.hasDiffuseTransmission() ||
         std::any_of(scene.triangleMaterials.begin(), scene.triangleMaterials.end(),
                     [&](std::uint32_t m) { return shines(scene.materials[m].albedo); });
}

}  // namespace prelight
