#pragma once

#include "bake/baker.h"
#include "bake/make_plan.h"
#include "support/devices.h"

namespace prelight::test {

struct BakeResult {
  Bake bake;
  BakeReport report;
};

/// Plans and bakes on the shared device; receivers' views are of `renderer`, if the request wants them drawn.
inline BakeResult runBake(const CompiledScene& scene, const BakeRequest& request, const Charts& charts = {},
                          HemisphereRenderer* renderer = nullptr) {
  BakeResult result;
  Progress progress;
  result.bake = bakeScene(scene, request, makePlan(Scene(), scene, request), sharedDevice(), progress,
                          result.report, &charts, nullptr, renderer);
  return result;
}

}  // namespace prelight::test
