#include "techniques/haar/haar_planning.h"

#include <fmt/format.h>

#include <algorithm>

#include "plan/cast_orders.h"

namespace prelight {

namespace {

constexpr std::uint64_t texelCodeBytes = 4;  // of a ray that is kept texel by texel

std::vector<PlannedPass> haarPasses(const PlanInput& input) {
  const BakeRequest& request = input.request;
  if (request.haar.size == 0) return {{Pass::HaarTransfer, false, "not asked for"}};
  return {{Pass::HaarTransfer, true,
           fmt::format("cube map of 6 x {0} x {0}, {1}, from the rays of the same cast{2}", request.haar.size,
                       plannedChannels(input.colored()),
                       input.colored() ? fmt::format("; {} through SH of order {}",
                                                     input.bounces ? "bounces" : "specular transport",
                                                     transferOrder(request))
                                       : "")}};
}

void addHaarMemory(const PlanInput& input, Plan& plan) {
  const BakeRequest& request = input.request;
  if (request.haar.size == 0) return;
  plan.texelBytes = std::min(plannedRays(input.scene, request) * texelCodeBytes, request.memory() / 4);
  plan.hostBytes += plan.texelBytes;
}

void addHaarToKey(const BakeRequest& request, StateHash& hash) {
  hash.value(request.haar.size).value(request.haar.error);
}

}  // namespace

Planning haarPlanning() {
  return {.passes = haarPasses, .addMemory = addHaarMemory, .addToKey = addHaarToKey};
}

}  // namespace prelight
