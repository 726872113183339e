#include "scene/emitters.h"

#include "scene/light_sources.h"

namespace prelight {

namespace {

void addEmitters(const CompiledScene& scene, std::uint32_t triangle, std::vector<Emitter>& emitters) {
  const glm::vec3& emission = scene.materials[scene.triangleMaterials[triangle]].emission;
  if (!shines(emission)) return;
  const double area = 0.5 * glm::length(geometricNormal(scene, triangle));
  const EmissionParts& parts = scene.emissionParts;
  if (parts.roots.empty()) return emitters.push_back({triangle, glm::vec2(0.0f), 1.0f, emission, area, 0});
  forEachPart(parts, parts.roots[triangle], [&](std::uint32_t index) {
    const EmissionParts::Part& part = parts.parts[index];
    const glm::vec3 radiance = emission * part.color;
    if (shines(radiance))
      emitters.push_back({triangle, part.origin, part.scale, radiance,
                          double(part.scale) * double(part.scale) * area, index});
  });
}

}  // namespace

std::vector<Emitter> emittersOf(const CompiledScene& scene) {
  std::vector<Emitter> emitters;
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t) addEmitters(scene, t, emitters);
  return emitters;
}

std::vector<Emitter> emittersOf(const CompiledScene& scene, std::uint32_t triangle) {
  std::vector<Emitter> emitters;
  addEmitters(scene, triangle, emitters);
  return emitters;
}

bool emits(const CompiledScene& scene, std::uint32_t triangle) {
  const EmissionParts& parts = scene.emissionParts;
  const glm::vec3& emission = scene.materials[scene.triangleMaterials[triangle]].emission;
  if (parts.roots.empty() || !shines(emission)) return shines(emission);
  bool any = false;
  forEachPart(parts, parts.roots[triangle],
              [&](std::uint32_t index) { any = any || shines(emission * parts.parts[index].color); });
  return any;
}

glm::vec3 meanEmission(const CompiledScene& scene, std::uint32_t triangle) {
  const EmissionParts& parts = scene.emissionParts;
  const glm::vec3& emission = scene.materials[scene.triangleMaterials[triangle]].emission;
  if (parts.roots.empty() || !shines(emission)) return emission;
  glm::dvec3 color(0.0);
  forEachPart(parts, parts.roots[triangle], [&](std::uint32_t index) {
    const EmissionParts::Part& part = parts.parts[index];
    color += double(part.scale) * double(part.scale) * glm::dvec3(part.color);
  });
  return emission * glm::vec3(color);
}

}  // namespace prelight
