#include "projectors/light_map/light_map_planning.h"

#include "projectors/light_map/light_map_plan.h"

namespace prelight {

namespace {

std::vector<PlannedPass> lightMapPasses(const PlanInput& input) {
  return planLightMap(input.scene, input.request);
}

void addLightMapMemory(const PlanInput& input, Plan& plan) {
  if (plan.runs(Pass::LightMap))
    plan.hostBytes += lightMapBytes(input.scene, input.request, lightMapCoefficients(plan));
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
