#include "techniques/radiosity/radiosity_planning.h"

#include <algorithm>

#include "radiosity/radiosity_plan.h"

namespace prelight {

namespace {

std::vector<PlannedPass> radiosityPasses(const PlanInput& input) {
  return planRadiosity(input.scene, input.request);
}

void addRadiosityMemory(const PlanInput& input, Plan& plan) {
  if (!plan.runs(Pass::Radiosity)) return;
  constexpr std::uint64_t blockBytes = std::uint64_t{40} << 20;  // direct light's rays, and the kernels
  constexpr std::uint64_t bytesPerElement = 700;  // its place, points of direct light and light on its way
  const RadiosityScale scale = radiosityScale(input.scene, input.request);
  const std::uint64_t bytes = std::min(input.request.memory(), scale.bytes());
  plan.hostBytes += bytes + bytesPerElement * scale.elements;
  plan.deviceBytes += bytes / 3 + blockBytes;
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
