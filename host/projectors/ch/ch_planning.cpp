#include "projectors/ch/ch_planning.h"

namespace prelight {

namespace {

std::vector<PlannedPass> passes(const PlanInput& input) {
  const BakeRequest& request = input.request;
  return {planHarmonics(Pass::ChTransfer, request.chOrder, input.bounces,
                        request.chNaive ? ", naive inner products" : ", an exact map of the SH transfer")};
}

void addToKey(const BakeRequest& request, StateHash& hash) {
  hash.value(request.chOrder).value(request.chNaive);
}

}  // namespace

Planning chPlanning() { return {.passes = passes, .addToKey = addToKey}; }

}  // namespace prelight
