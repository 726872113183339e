#include "techniques/near_lamps/near_lamps_planning.h"

#include <fmt/format.h>

#include <algorithm>

#include "plan/cast_orders.h"
#include "transfer/near_lamps.h"

namespace prelight {

namespace {

PlannedPass planNearLamps(const PlanInput& input) {
  const int shells = input.request.nearLamps.shells, order = nearLampOrder(input.request);
  if (order == 0)
    return {Pass::NearLamps, false, "they use the bands of SH or CH transfer, and neither is asked for"};
  const glm::vec3 extent = input.scene.boundsMax - input.scene.boundsMin;
  if (std::min({extent.x, extent.y, extent.z}) <= 0.0f)
    return {Pass::NearLamps, false,
            "the scene is flat: no lamp within its bounds has anything in front of it"};
  const ShellRange range = shellRange(input.scene);
  return {Pass::NearLamps, true,
          fmt::format("{} shells of distance from {:.3g} to {:.3g} m, order {}, without further rays", shells,
                      range.nearest, range.farthest, order)};
}

std::vector<PlannedPass> nearLampsPasses(const PlanInput& input) {
  if (input.request.nearLamps.shells == 0) return {};
  return {planNearLamps(input)};
}

/// Sums of the fit, its solution, and what is stored of it.
void addNearLampsMemory(const PlanInput& input, Plan& plan) {
  if (!plan.runs(Pass::NearLamps)) return;
  const auto order = static_cast<std::uint64_t>(nearLampOrder(input.request));
  const auto values = order * order * static_cast<std::uint64_t>(input.request.nearLamps.shells);
  plan.hostBytes += input.scene.vertexCount() * values * (4 + 4 + 2) + 24ull * input.scene.triangleCount();
}

const char* nearLampsHits(const BakeRequest& request) {
  return request.nearLamps.shells > 0 && nearLampOrder(request) > 0
             ? "closest hits, because near lamps need to know how far it is to what was hit"
             : nullptr;
}

void addNearLampsToKey(const BakeRequest& request, StateHash& hash) {
  if (request.nearLamps.shells > 0) hash.value(request.nearLamps.shells);
}

}  // namespace

Planning nearLampsPlanning() {
  return {.passes = nearLampsPasses,
          .addMemory = addNearLampsMemory,
          .closestHits = nearLampsHits,
          .addToKey = addNearLampsToKey};
}

}  // namespace prelight
