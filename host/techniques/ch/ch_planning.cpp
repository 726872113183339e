#include "techniques/ch/ch_planning.h"

namespace prelight {

namespace {

std::vector<PlannedPass> chPasses(const PlanInput& input) {
  const BakeRequest& request = input.request;
  return {planHarmonics(Pass::ChTransfer, request.ch.order, input.colored(),
                        request.ch.naive ? ", naive inner products" : ", an exact map of the SH transfer")};
}

void addChToKey(const BakeRequest& request, StateHash& hash) {
  hash.value(request.ch.order).value(request.ch.naive);
}

}  // namespace

Planning chPlanning() { return {.passes = chPasses, .addToKey = addChToKey}; }

}  // namespace prelight
