#include "prelight/plan.h"

#include <algorithm>

namespace prelight {

bool Plan::runs(Pass pass) const {
  return std::any_of(passes.begin(), passes.end(),
                     [&](const PlannedPass& planned) { return planned.name == pass.name && planned.runs; });
}

}  // namespace prelight
