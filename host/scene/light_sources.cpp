#include "scene/light_sources.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "scene/light_profile.h"
#include "scene/light_shape.h"

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

bool shinesWithin(const Light& light, const CompiledScene& scene) {
  return light.type != LightType::Directional && shines(light.intensity) && liesWithin(light, scene);
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

const Environment* shiningSky(const Environment* sky) {
  if (sky == nullptr) return nullptr;
  return std::any_of(sky->radiance.begin(), sky->radiance.end(), shines) ? sky : nullptr;
}

bool hasEmitters(const CompiledScene& scene) {
  for (std::uint32_t t = 0; t < scene.triangleCount(); ++t)
    if (emits(scene, t)) return true;
  return false;
}

std::string lampsWithin(const CompiledScene& scene) {
  const glm::vec3 extent = scene.boundsMax - scene.boundsMin;
  if (std::min({extent.x, extent.y, extent.z}) <= 0.0f) return "";
  const auto within = [&](const Light& light) { return shinesWithin(light, scene); };
  const auto first = std::find_if(scene.lights.begin(), scene.lights.end(), within);
  if (first == scene.lights.end()) return hasEmitters(scene) ? "emissive surfaces" : "";
  const auto others = std::count_if(first + 1, scene.lights.end(), within);
  const std::string name = first->name.empty() ? "a light" : fmt::format("light '{}'", first->name);
  return others > 0 ? fmt::format("{} and {} more", name, others) : name;
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

device::PunctualLight deviceLight(const Light& light, const CompiledScene& scene) {
  device::PunctualLight d{};
  const glm::vec3 position(light.position - scene.origin);
  for (int c = 0; c < 3; ++c) {
    d.position[c] = position[c];
    d.intensity[c] = light.intensity[c];
    d.direction[c] = static_cast<float>(light.direction[c]);
  }
  d.kind = light.type == LightType::Directional ? PRELIGHT_DIRECTIONAL_LIGHT
           : light.type == LightType::Spot      ? PRELIGHT_SPOT_LIGHT
                                                : PRELIGHT_POINT_LIGHT;
  d.radius = light.radius;
  d.inverseRange = light.range > 0.0f ? 1.0f / light.range : 0.0f;
  // KHR_lights_punctual, "Inner and outer cone angles".
  const double outer = std::cos(static_cast<double>(light.outerConeAngle));
  const double scale = 1.0 / std::max(0.001, std::cos(static_cast<double>(light.innerConeAngle)) - outer);
  d.coneScale = static_cast<float>(scale);
  d.coneOffset = static_cast<float>(-outer * scale);
  if (light.profile == nullptr) return d;
  d.kind = PRELIGHT_PROFILED_LIGHT;
  const glm::vec3 pole = profilePole(light);
  for (int c = 0; c < 3; ++c) d.direction[c] = pole[c];
  d.profileStart = profileTurn(light);
  return d;
}

}  // namespace prelight
