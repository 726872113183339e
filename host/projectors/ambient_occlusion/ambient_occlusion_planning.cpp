#include "projectors/ambient_occlusion/ambient_occlusion_planning.h"

namespace prelight {

namespace {

std::vector<PlannedPass> passes(const PlanInput& input) {
  const bool asked = input.request.ao;
  return {{Pass::AmbientOcclusion, asked, asked ? "with bent normal, from the same cast" : "not asked for"}};
}

void addToKey(const BakeRequest& request, StateHash& hash) { hash.value(request.ao); }

}  // namespace

Planning ambientOcclusionPlanning() { return {.passes = passes, .addToKey = addToKey}; }

}  // namespace prelight
