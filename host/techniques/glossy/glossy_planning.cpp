#include "techniques/glossy/glossy_planning.h"

#include <fmt/format.h>

namespace prelight {

namespace {

/// Entries of a matrix.
template <typename T>
T entriesOf(T order) {
  return order * order * order * order;
}

std::vector<PlannedPass> glossyPasses(const PlanInput& input) {
  const int order = input.request.glossy.order;
  if (order == 0) return {{Pass::GlossyTransfer, false, "not asked for"}};
  return {{Pass::GlossyTransfer, true,
           fmt::format("order {}, {} entries per matrix, {}; from SH transfer of order {}", order,
                       entriesOf(order), plannedChannels(input.colored()), 2 * order - 1)}};
}

void addGlossyMemory(const PlanInput& input, Plan& plan) {
  plan.hostBytes += input.scene.vertexCount() *
                    entriesOf(static_cast<std::uint64_t>(input.request.glossy.order)) * 4 *
                    (input.bounces ? 6 : 2);
}

void addGlossyToKey(const BakeRequest& request, StateHash& hash) { hash.value(request.glossy.order); }

}  // namespace

Planning glossyPlanning() {
  return {.passes = glossyPasses, .addMemory = addGlossyMemory, .addToKey = addGlossyToKey};
}

}  // namespace prelight
