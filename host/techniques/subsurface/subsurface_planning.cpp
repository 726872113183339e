#include "techniques/subsurface/subsurface_planning.h"

namespace prelight {

namespace {

void addSubsurfaceToKey(const BakeRequest& request, StateHash& hash) {
  if (request.subsurface) hash.text("subsurface");
}

}  // namespace

Planning subsurfacePlanning() { return {.addToKey = addSubsurfaceToKey}; }

}  // namespace prelight
