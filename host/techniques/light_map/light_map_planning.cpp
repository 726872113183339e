#include "techniques/light_map/light_map_planning.h"

#include <algorithm>

#include "cast/light_caster.h"
#include "gi/gi_memory.h"
#include "techniques/light_map/light_map_light.h"
#include "techniques/light_map/light_map_plan.h"

namespace prelight {

namespace {

constexpr std::uint64_t mostReceivers = 8192;  // receivers that direct light is cast from at once

std::vector<PlannedPass> lightMapPasses(const PlanInput& input) {
  return planLightMap(input.scene, input.request);
}

/// Photons that leave lights for a map of so many texels.
std::uint64_t photonsFor(const BakeRequest& request, std::uint64_t texels) {
  constexpr std::uint64_t photonsForFilters = 4;
  if (request.lightMap.photons > 0) return request.lightMap.photons;
  return usualPhotons(texels) * (request.lightMap.denoise ? photonsForFilters : 1);
}

/// The texels, and the largest of what follows one another: direct light, then photons.
void addLightMapMemory(const PlanInput& input, Plan& plan) {
  if (!plan.runs(Pass::LightMap)) return;
  const int coefficients = lightMapCoefficients(plan);
  plan.hostBytes += lightMapBytes(input.scene, input.request, coefficients);
  const LightCounts lights = countLights(input.scene, {{"all", {"*"}}});
  const std::uint64_t direct =
      plan.runs(Pass::DirectLightOfTheMap)
          ? lightBlockBytesOf(lights.rays, lights.groups, static_cast<std::uint64_t>(coefficients),
                              mostReceivers)
          : 0;
  const std::uint64_t photons = photonsFor(input.request, mostTexels(input.scene, input.request));
  const std::uint64_t indirect =
      plan.runs(Pass::IndirectLightOfTheMap) ? indirectLightBytes(input.scene, photons) : 0;
  plan.deviceBytes += std::max(direct, indirect);
}

void addLightMapToKey(const BakeRequest& request, StateHash& hash) {
  hash.value(request.lightMap.wanted).value(request.lightMap.texelSize).value(request.lightMap.error);
  hash.value(request.lightMap.caustics).value(request.lightMap.photons);
  if (request.lightMap.denoise && request.lightMap.photons == 0) hash.value(true);  // more of them
}

}  // namespace

Planning lightMapPlanning() {
  return {.staticLight = true,
          .passes = lightMapPasses,
          .addMemory = addLightMapMemory,
          .addToKey = addLightMapToKey};
}

}  // namespace prelight
