#include "techniques/ambient_occlusion/ambient_occlusion_planning.h"

namespace prelight {

namespace {

std::vector<PlannedPass> ambientOcclusionPasses(const PlanInput& input) {
  const bool asked = input.request.ao;
  return {{Pass::AmbientOcclusion, asked, asked ? "with bent normal, from the same cast" : "not asked for"}};
}

void addAmbientOcclusionToKey(const BakeRequest& request, StateHash& hash) { hash.value(request.ao); }

}  // namespace

Planning ambientOcclusionPlanning() {
  return {.passes = ambientOcclusionPasses, .addToKey = addAmbientOcclusionToKey};
}

}  // namespace prelight
