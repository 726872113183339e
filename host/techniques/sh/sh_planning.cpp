#include "techniques/sh/sh_planning.h"

namespace prelight {

namespace {

std::vector<PlannedPass> shPasses(const PlanInput& input) {
  return {planHarmonics(Pass::ShTransfer, input.request.sh.order, input.colored(), "")};
}

void addShToKey(const BakeRequest& request, StateHash& hash) { hash.value(request.sh.order); }

}  // namespace

Planning shPlanning() { return {.passes = shPasses, .addToKey = addShToKey}; }

}  // namespace prelight
