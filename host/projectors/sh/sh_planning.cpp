#include "projectors/sh/sh_planning.h"

namespace prelight {

namespace {

std::vector<PlannedPass> passes(const PlanInput& input) {
  return {planHarmonics(Pass::ShTransfer, input.request.shOrder, input.bounces, "")};
}

void addToKey(const BakeRequest& request, StateHash& hash) { hash.value(request.shOrder); }

}  // namespace

Planning shPlanning() { return {.passes = passes, .addToKey = addToKey}; }

}  // namespace prelight
