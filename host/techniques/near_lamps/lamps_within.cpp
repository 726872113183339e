#include "techniques/near_lamps/lamps_within.h"

#include <fmt/format.h>

#include <algorithm>

#include "scene/light_sources.h"

namespace prelight {

namespace {

bool liesWithin(const Light& light, const CompiledScene& scene) {
  if (light.type == LightType::Directional || !shines(light.intensity)) return false;
  const glm::dvec3 place = light.position - scene.origin;
  const glm::dvec3 lower(scene.boundsMin), upper(scene.boundsMax);
  return glm::clamp(place, lower, upper) == place;
}

}  // namespace

std::string lampsWithin(const CompiledScene& scene) {
  const glm::vec3 extent = scene.boundsMax - scene.boundsMin;
  if (std::min({extent.x, extent.y, extent.z}) <= 0.0f) return "";
  const auto within = [&](const Light& light) { return liesWithin(light, scene); };
  const auto first = std::find_if(scene.lights.begin(), scene.lights.end(), within);
  if (first == scene.lights.end()) return hasEmitters(scene) ? "emissive surfaces" : "";
  const auto others = std::count_if(first + 1, scene.lights.end(), within);
  const std::string name = first->name.empty() ? "a light" : fmt::format("light '{}'", first->name);
  return others > 0 ? fmt::format("{} and {} more", name, others) : name;
}

}  // namespace prelight
