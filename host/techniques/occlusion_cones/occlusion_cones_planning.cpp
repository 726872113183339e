#include "techniques/occlusion_cones/occlusion_cones_planning.h"

namespace prelight {

namespace {

std::vector<PlannedPass> occlusionConesPasses(const PlanInput& input) {
  if (!input.request.cones) return {};
  return {{Pass::OcclusionCones, true, "from ambient occlusion and bent normal, without further rays"}};
}

void addOcclusionConesToKey(const BakeRequest& request, StateHash& hash) {
  if (request.cones) hash.value(request.cones);
}

}  // namespace

Planning occlusionConesPlanning() {
  return {.passes = occlusionConesPasses, .addToKey = addOcclusionConesToKey};
}

}  // namespace prelight
