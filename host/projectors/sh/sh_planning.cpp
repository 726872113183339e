#include "projectors/sh/sh_planning.h"

namespace prelight {

namespace {

std::vector<PlannedPass> passes(const PlanInput& input) {
  return {planHarmonics(Pass::ShTransfer, input.request.sh.order, input.bounces, "")};
}

void addToKey(const BakeRequest& request, StateHash& hash) { hash.value(request.sh.order); }

}  // namespace

Planning shPlanning() { return {.passes = passes, .addToKey = addToKey}; }

}  // namespace prelight
