#include "projectors/radiosity/radiosity_planning.h"

#include <algorithm>

#include "radiosity/radiosity_plan.h"

namespace prelight {

namespace {

std::vector<PlannedPass> radiosityPasses(const PlanInput& input) {
  return planRadiosity(input.scene, input.request);
}

void addRadiosityMemory(const PlanInput& input, Plan& plan) {
  if (!plan.runs(Pass::Radiosity)) return;
  const std::uint64_t bytes =
      std::min(input.request.memory(), radiosityScale(input.scene, input.request).bytes());
  plan.hostBytes += bytes;
  plan.deviceBytes += bytes / 3;
}

void addRadiosityToKey(const BakeRequest& request, StateHash& hash) { hash.value(request.radiosity.wanted); }

}  // namespace

Planning radiosityPlanning() {
  return {.staticLight = true,
          .passes = radiosityPasses,
          .addMemory = addRadiosityMemory,
          .addToKey = addRadiosityToKey};
}

}  // namespace prelight
